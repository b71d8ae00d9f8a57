// SPDX-License-Identifier: MIT
#include "apps/work/reproduction.hpp"

#include <filesystem>

#include "apps/work/folder.hpp"
#include "lib/core/atomic_file.hpp"

namespace faultline {
namespace {

/// Writes pictures first, the pages that refer to them last.
void write_reproduction(const std::filesystem::path& folder, const Reproduction& reproduction,
                        const std::string& json) {
  for (const Figure& figure : reproduction.figures)
    write_file((folder / (figure.id + ".svg")).string(), render_svg(figure.plot));
  write_file((folder / "index.md").string(), reproduction_markdown(reproduction));
  write_file((folder / "index.json").string(), json);
}

}  // namespace

ReproducedFolder reproduce_into(const std::string& folder, const ReproduceOptions& options,
                                const Progress& progress) {
  options.check();
  make_folder(folder);
  ReproducedFolder out{reproduce(options, progress), {}};
  out.json = reproduction_json(out.reproduction);
  write_reproduction(folder, out.reproduction, out.json);
  return out;
}

}  // namespace faultline
