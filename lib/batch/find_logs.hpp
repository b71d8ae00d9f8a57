// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace faultline {

struct BatchLog {
  std::string path;  ///< where to read it
  /// What every result calls it: below a folder that was given, with that folder's own name in front; the
  /// bare file name of a file that was given. No folder of a machine is in it.
  std::string name;
  int model = 0;                      ///< place in the models of the batch
  std::vector<std::string> beside{};  ///< paths of the other files that the log consists of
};

/// The logs at `paths`, files and folders in any order, each once, sorted by name. A file that was given is
/// taken whatever it is. Of a folder, with all below it, the files whose name ends in one of `endings`
/// (".csv", ".csv.gz") are taken, but not hidden ones, tables that start with "file," (labels.csv and our
/// reports) nor results of a batch. What cannot be read stays in the list: reading it says why. Throws
/// Error(input) when a path is not there.
std::vector<BatchLog> find_logs(const std::vector<std::string>& paths,
                                const std::vector<std::string>& endings);

/// Returns the logs, each with the model whose folder it lies in (BatchLog::model = place in `folders`):
/// `folders` holds the folder of each model, "" for the model of all other logs. A log lies in a folder when
/// its file does, or when the parts of the folder's name follow each other in the log's name; of several the
/// deepest counts. Throws Error(usage) when a log has no model, a folder has two, or there is no folder of a
/// name.
std::vector<BatchLog> with_models(std::vector<BatchLog> logs, const std::vector<std::string>& folders);

}  // namespace faultline
