#!/bin/bash
# SPDX-License-Identifier: MIT
# A Slurm job array over one batch, and a job that merges its parts when all are done:
#
#   export LOGS=runs MODEL=robot.model OUT=out/runs PARTS=8      # on a file system that all nodes see
#   job=$(sbatch --parsable --array=1-$PARTS apps/batch_slurm.sh)
#   sbatch --dependency=afterok:$job --kill-on-invalid-dep=yes apps/batch_slurm.sh
#
# Each task takes the part of its number; the second job has no task number and merges. A task that is requeued,
# submitted again (--array=3) or run twice goes on where the first try stopped. FAULTLINE and BATCH_OPTIONS (such as
# --html) may be set, too.
#SBATCH --job-name=faultline
#SBATCH --cpus-per-task=2
#SBATCH --requeue
#SBATCH --open-mode=append
set -euo pipefail
faultline=${FAULTLINE:-faultline}
: "${OUT:?set OUT to the folder for the results}" "${PARTS:?set PARTS to the number of tasks}"

# Faults found (1) and unusable logs (3, a row each) are results: a task with them has not failed when it is finished.
accept() { [ "$1" -eq 0 ] || [ "$1" -eq 1 ] || [ "$1" -eq 3 ]; }

status=0
if [ -n "${SLURM_ARRAY_TASK_ID:-}" ]; then
  rm -f "$OUT/part-$SLURM_ARRAY_TASK_ID/.batch/finished.json"
  # shellcheck disable=SC2086
  "$faultline" batch ${LOGS:?set LOGS to files or folders} --model "${MODEL:?set MODEL}" \
    -o "$OUT/part-$SLURM_ARRAY_TASK_ID" --shard "$SLURM_ARRAY_TASK_ID/$PARTS" \
    --threads "${SLURM_CPUS_PER_TASK:-1}" --wait ${BATCH_OPTIONS:-} || status=$?
  accept $status && [ -f "$OUT/part-$SLURM_ARRAY_TASK_ID/.batch/finished.json" ]
else
  rm -f "$OUT/all/.batch/finished.json"
  parts=()
  for i in $(seq "$PARTS"); do parts+=("$OUT/part-$i"); done
  "$faultline" batch merge "${parts[@]}" -o "$OUT/all" || status=$?
  accept $status && [ -f "$OUT/all/.batch/finished.json" ]
fi
