// SPDX-License-Identifier: MIT
// Drop zones and live progress; without it, forms and links do the same.
'use strict';

/** Sends a form with its files and shows how much arrived; then goes where the service says. */
function send(form) {
  const status = form.querySelector('[role=status]');
  const bar = form.querySelector('progress');
  const button = form.querySelector('button');
  const request = new XMLHttpRequest();
  const stop = sentence => {
    status.textContent = sentence;
    bar.hidden = true;
    button.disabled = false;
  };
  request.open('POST', form.action);
  request.setRequestHeader('Accept', 'application/json');
  request.upload.onprogress = event => {
    if (!event.lengthComputable) return;
    bar.value = event.loaded / event.total;
    status.textContent = `Sending: ${Math.round(100 * bar.value)} %`;
  };
  request.onload = () => {
    let answer = {};
    try { answer = JSON.parse(request.responseText); } catch (error) { answer = {}; }
    if (answer.location) location.href = answer.location;
    else stop(answer.sentence || `The service answered ${request.status}; load the page again and repeat.`);
  };
  request.onerror = () => stop('The connection was lost, and nothing was kept. Send it again.');
  bar.hidden = false;
  button.disabled = true;
  status.textContent = 'Sending';
  request.send(new FormData(form));
}

for (const form of document.querySelectorAll('form.drop')) {
  const input = form.querySelector('input[type=file]');
  form.addEventListener('submit', event => { event.preventDefault(); send(form); });
  const over = on => event => { event.preventDefault(); form.classList.toggle('over', on); };
  form.addEventListener('dragover', over(true));
  form.addEventListener('dragleave', over(false));
  form.addEventListener('drop', event => {
    over(false)(event);
    input.files = event.dataTransfer.files;
    if (form.reportValidity()) send(form);
  });
}

/** Follows a job that has not ended, and loads its page again when it has. */
async function follow(element) {
  const bar = element.querySelector('progress');
  const status = element.querySelector('[role=status]');
  for (;;) {
    await new Promise(done => setTimeout(done, 300));
    let job;
    try {
      const answer = await fetch(`${location.pathname}/state.json`, {redirect: 'manual'});
      if (!answer.ok) { location.reload(); return; }   // deleted, or logged out
      job = await answer.json();
    } catch (error) {
      status.textContent = 'The service does not answer; this page tries again.';
      continue;
    }
    if (job.ended) { location.reload(); return; }
    if (job.sentence !== status.textContent) status.textContent = job.sentence;
    if (job.share >= 0) bar.value = job.share;
  }
}
for (const element of document.querySelectorAll('[data-job]')) follow(element);
