# SPDX-License-Identifier: MIT
# Processor time of data.table's fread on one thread. Usage: Rscript csv_speed.R FILE
suppressMessages(library(data.table))
setDTthreads(1)
file <- commandArgs(trailingOnly = TRUE)[1]
used <- system.time(rows <- nrow(fread(file, nThread = 1, showProgress = FALSE)))
cat(sprintf("%.4f %.4f %d\n", used[["user.self"]] + used[["sys.self"]], used[["elapsed"]], rows))
