#!/usr/bin/env cwl-runner
# SPDX-License-Identifier: MIT
# A batch, or one part of it (shard), as a tool of the Common Workflow Language:
#
#   cwltool apps/fleets/batch.cwl --logs runs --model robot.model
cwlVersion: v1.2
class: CommandLineTool
label: Diagnose all logs of a folder with faultline
baseCommand: [faultline, batch]
arguments: [-o, $(inputs.results_name)]
inputs:
  logs:
    type: Directory
    doc: Logs, with those of its subfolders
    inputBinding: {position: 1}
  model:
    type: File
    doc: Model made by faultline learn, with its case base beside it
    secondaryFiles: [{pattern: .cases.db, required: true}]
    inputBinding: {prefix: --model}
  shard:
    type: string?
    doc: Part of the list of logs, such as 3/8
    inputBinding: {prefix: --shard}
  html:
    type: boolean?
    doc: Also write a page for each log
    inputBinding: {prefix: --html}
  threads:
    type: int?
    doc: Number of logs diagnosed at once
    inputBinding: {prefix: --threads}
  results_name:
    type: string
    default: results
    doc: Name of the folder for the results
outputs:
  results:
    type: Directory
    outputBinding: {glob: $(inputs.results_name)}
  summary: stdout
stdout: summary.txt
# Faults found (1) and unusable logs (3, a row each) are results.
successCodes: [0, 1, 3]
