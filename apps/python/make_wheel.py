# SPDX-License-Identifier: MIT
"""Packs the built package into a wheel: make_wheel.py PACKAGE VERSION SOURCE_ROOT OUT

The same package gives the same bytes. Only the standard library is needed.
"""
import base64
import hashlib
import pathlib
import sys
import sysconfig
import zipfile

OLDEST = (1980, 1, 1, 0, 0, 0)  # that a zip file can tell
READABLE = 0o644 << 16


def metadata(version, readme):
    return (
        "Metadata-Version: 2.1\n"
        "Name: faultline\n"
        f"Version: {version}\n"
        "Summary: Fault diagnosis of SCARA robots from recorded joint logs\n"
        "License: MIT\n"
        "Requires-Python: >=3.9\n"
        "Requires-Dist: numpy>=1.20\n"
        "Provides-Extra: frames\n"
        "Requires-Dist: pandas>=1.3; extra == 'frames'\n"
        "Provides-Extra: onnx\n"
        "Requires-Dist: onnx>=1.12; extra == 'onnx'\n"
        "Provides-Extra: plots\n"
        "Requires-Dist: matplotlib; extra == 'plots'\n"
        "Description-Content-Type: text/markdown\n"
        "\n"
    ) + readme


def tag():
    interpreter = "cp%d%d" % sys.version_info[:2]
    platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    return f"{interpreter}-{interpreter}-{platform}"


def record_line(name, content):
    digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
    return f"{name},sha256={digest},{len(content)}\n"


def files_of(package, version, root):
    """Name in the wheel and content, the compiled part of this interpreter only."""
    suffix = sysconfig.get_config_var("EXT_SUFFIX")
    for path in sorted(package.iterdir()):
        if path.suffix in (".py", ".pyi", ".typed") or path.name == "py.typed" or path.name.endswith(suffix):
            yield f"faultline/{path.name}", path.read_bytes()
    info = f"faultline-{version}.dist-info"
    wheel = f"Wheel-Version: 1.0\nGenerator: faultline\nRoot-Is-Purelib: false\nTag: {tag()}\n"
    yield f"{info}/METADATA", metadata(version, (root / "docs/python.md").read_text("utf-8")).encode()
    yield f"{info}/WHEEL", wheel.encode()
    yield f"{info}/LICENSE", (root / "LICENSE").read_bytes()


def write_wheel(package, version, root, out):
    out.mkdir(parents=True, exist_ok=True)
    target = out / f"faultline-{version}-{tag()}.whl"
    files = list(files_of(package, version, root))
    if not any(name.endswith(".so") for name, _ in files):
        sys.exit(
            f"make_wheel: {package} has no compiled part for this Python; build the target faultline_python"
        )
    record = f"faultline-{version}.dist-info/RECORD"
    lines = "".join(record_line(name, content) for name, content in files) + f"{record},,\n"
    unfinished = target.with_suffix(".tmp")
    with zipfile.ZipFile(unfinished, "w", zipfile.ZIP_DEFLATED) as wheel:
        for name, content in files + [(record, lines.encode())]:
            entry = zipfile.ZipInfo(name, OLDEST)
            entry.external_attr = READABLE
            entry.compress_type = zipfile.ZIP_DEFLATED
            wheel.writestr(entry, content)
    unfinished.replace(target)
    return target


if __name__ == "__main__":
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    print(
        write_wheel(
            pathlib.Path(sys.argv[1]), sys.argv[2], pathlib.Path(sys.argv[3]), pathlib.Path(sys.argv[4])
        )
    )
