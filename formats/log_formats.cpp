// SPDX-License-Identifier: MIT
#include "formats/log_formats.hpp"

#include <algorithm>
#include <iterator>

#include "formats/known_formats.hpp"

namespace faultline {

const std::vector<LogFormat>& log_formats() {
  // MATLAB comes before HDF5, on which its version 7.3 is based. CSV comes last, as it accepts any text; the
  // headers of DIAdem share its extension .dat.
  static const std::vector<LogFormat> table{
      {"native", "binary, exact, fast", {".flog"}, looks_like_native, open_native, create_native},
      {"mcap", "for Foxglove and PlotJuggler", {".mcap"}, looks_like_mcap, open_mcap, create_mcap},
      {"rosbag1", "ROS 1 bag", {".bag"}, looks_like_rosbag1, open_rosbag1, nullptr},
      {"rosbag2", "ROS 2 bag in SQLite", {".db3"}, looks_like_rosbag2, open_rosbag2, nullptr},
      {"matlab", "MATLAB", {".mat"}, looks_like_matlab, open_matlab, create_matlab},
      {"hdf5", "HDF5", {".h5", ".hdf5"}, looks_like_hdf5, open_hdf5, create_hdf5},
      {"npz", "for NumPy", {".npz"}, looks_like_npz, open_npz, create_npz},
      {"npy", "one array of NumPy", {".npy"}, looks_like_npy, open_npy, nullptr},
      {"diadem", "DIAdem, such as KUKA Trace", {}, looks_like_diadem, open_diadem, nullptr},
      {"csv", "text", {".csv", ".txt", ".tsv", ".dat"}, looks_like_csv, open_csv, create_csv},
  };
  return table;
}

std::vector<std::string> log_extensions() {
  std::vector<std::string> all;
  for (const LogFormat& format : log_formats())
    all.insert(all.end(), format.extensions.begin(), format.extensions.end());
  return all;
}

std::vector<std::string> log_name_endings() {
  std::vector<std::string> all = log_extensions();
  for (const std::string& extension : log_extensions())
    for (const char* packing : {".gz", ".zst"}) all.push_back(extension + packing);
  return all;
}

std::vector<LogFormat> written_formats() {
  std::vector<LogFormat> written;
  std::copy_if(log_formats().rbegin(), log_formats().rend(), std::back_inserter(written),
               [](const LogFormat& format) { return format.create != nullptr; });
  return written;
}

std::string either_of(const std::vector<std::string>& choices) {
  std::string text = choices.front();
  for (std::size_t i = 1; i < choices.size(); ++i)
    text += (i + 1 < choices.size() ? ", " : " or ") + choices[i];
  return text;
}

}  // namespace faultline
