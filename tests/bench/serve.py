# SPDX-License-Identifier: MIT
"""Uploads, kills and times of faultline serve. Usage: serve.py PROGRAM MODEL LOG UPLOADS KILLS LONG_LOG..."""
import http.client
import os
import random
import re
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import threading
import time

PROGRAM, MODEL, LOG, UPLOADS, KILLS, LONG_LOGS = *sys.argv[1:4], int(sys.argv[4]), int(sys.argv[5]), sys.argv[6:]
BOUNDARY = "faultline-bench"


class Service:
    def __init__(self, folder):
        self.folder, self.port, self.process = folder, 0, None
        self.start()

    def start(self):
        self.process = subprocess.Popen(
            [PROGRAM, "serve", self.folder, "--port", str(self.port)], stderr=subprocess.PIPE, text=True)
        self.port = int(re.search(r"http://[^:]+:(\d+)/", self.process.stderr.readline())[1])

    def kill(self):
        self.process.send_signal(signal.SIGKILL)
        self.process.wait()
        self.process.stderr.close()


class Visitor:
    """One user with a cookie; tries again while the service is down."""

    def __init__(self, service):
        self.service, self.cookie = service, ""

    def ask(self, method, path, body=b"", kind=""):
        connection = http.client.HTTPConnection("127.0.0.1", self.service.port, timeout=60)
        headers = {"Cookie": self.cookie}
        if kind:
            headers["Content-Type"] = kind
        try:
            connection.request(method, path, body, headers)
            answer = connection.getresponse()
            text = answer.read()
        finally:
            connection.close()
        if answer.getheader("Set-Cookie"):
            self.cookie = answer.getheader("Set-Cookie").split(";")[0]
        return answer.status, text, answer.getheader("Location")

    def key(self):
        return re.search(rb'name="key" value="([0-9a-f]+)"', self.ask("GET", "/learn")[1])[1].decode()

    def upload(self, name, log):
        fields = {"key": self.key(), "kind": "diagnose", "model": "bench.model"}
        body = b"".join(
            f'--{BOUNDARY}\r\nContent-Disposition: form-data; name="{k}"\r\n\r\n{v}\r\n'.encode() for k, v in fields.items())
        body += (f'--{BOUNDARY}\r\nContent-Disposition: form-data; name="log"; filename="{name}"\r\n'
                 "Content-Type: text/csv\r\n\r\n").encode() + log + f"\r\n--{BOUNDARY}--\r\n".encode()
        status, _, location = self.ask("POST", "/jobs", body, f"multipart/form-data; boundary={BOUNDARY}")
        return location if status == 303 else None

    def result(self, job):
        while b'"ended":true' not in self.ask("GET", job + "/state.json")[1]:
            time.sleep(0.02)
        return self.ask("GET", job)[1]


def uploads_and_kills(service, log):
    acknowledged, lock = [], threading.Lock()
    todo = iter(range(UPLOADS))

    def work():
        visitor = Visitor(service)
        while True:
            with lock:
                number = next(todo, None)
            if number is None:
                return
            while True:
                try:
                    job = visitor.upload(f"run_{number}.csv", log)
                except (OSError, http.client.HTTPException, TypeError):
                    time.sleep(0.05)
                    continue
                if job:
                    with lock:
                        acknowledged.append((number, job))
                    break

    users = [threading.Thread(target=work) for _ in range(2)]
    for user in users:
        user.start()
    random.seed(3)
    for _ in range(KILLS):
        time.sleep(random.uniform(0.1, 1.0))
        service.kill()
        service.start()
    for user in users:
        user.join()
    visitor, lost, wrong = Visitor(service), 0, 0
    for number, job in acknowledged:
        page = visitor.result(job)
        lost += f"run_{number}.csv".encode() not in page
        wrong += b"joint 1 is locked" not in page
    print(f"uploads {UPLOADS}, kills {KILLS}: acknowledged {len(acknowledged)}, lost {lost}, without their result {wrong}")


def times(service):
    visitor, taken = Visitor(service), []
    for path in ["/", "/robots/bench.model", "/jobs/1", "/learn"] * 25:
        begin = time.perf_counter()
        assert visitor.ask("GET", path)[0] == 200
        taken.append(1000 * (time.perf_counter() - begin))
    print(f"a page: median {statistics.median(taken):.1f} ms, slowest of {len(taken)} {max(taken):.1f} ms")
    for path in LONG_LOGS:
        with open(path, "rb") as file:
            log = file.read()
        name, rows, taken = os.path.basename(path), log.count(b"\n") - 1, []
        for i in range(5):
            begin = time.perf_counter()
            visitor.result(visitor.upload(f"{i}_{name}", log))
            taken.append(time.perf_counter() - begin)
        print(f"upload, diagnosis and report of {rows} rows, {name}: median {statistics.median(taken):.2f} s, "
              f"slowest of 5 {max(taken):.2f} s")


def main():
    with tempfile.TemporaryDirectory() as folder:
        for ending in ["", ".cases.db"]:
            shutil.copy(MODEL + ending, os.path.join(folder, "bench.model" + ending))
        with open(LOG, "rb") as file:
            log = file.read()
        service = Service(folder)
        try:
            uploads_and_kills(service, log)
            times(service)
        finally:
            service.kill()


main()
