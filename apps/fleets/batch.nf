// SPDX-License-Identifier: MIT
// A batch in parts, and their merge, by Nextflow:
//
//   nextflow run apps/fleets/batch.nf --logs runs --model robot.model --parts 8
nextflow.enable.dsl = 2
params.parts = 8
params.out = "out"

// Faults found (1) and unusable logs (3, a row each) are results.
process part {
  cpus 2
  input: tuple val(number), path(logs), path(model), path(cases)
  output: path "part-${number}"
  script:
  """
  faultline batch ${logs} --model ${model} --cases ${cases} -o part-${number} --shard ${number}/${params.parts} \\
    --threads ${task.cpus} || case \$? in 1|3) ;; *) exit 1 ;; esac
  """
}

process merge {
  publishDir params.out
  input: path parts
  output: path "all"
  script:
  """
  faultline batch merge ${parts} -o all || case \$? in 1|3) ;; *) exit 1 ;; esac
  """
}

workflow {
  numbers = Channel.of(1..params.parts)
  files = numbers.map { tuple(it, file(params.logs), file(params.model), file("${params.model}.cases.db")) }
  merge(part(files).collect())
}
