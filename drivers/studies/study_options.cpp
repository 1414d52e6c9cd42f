#include "drivers/studies/study_options.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "io/cases/keys_material.hpp"

namespace breccia {

std::vector<int> doubling(int cores) {
  std::vector<int> threads;
  for (int n = 1; n < cores; n *= 2) threads.push_back(n);
  threads.push_back(cores);
  return threads;
}

void add_results_options(CLI::App& app, std::filesystem::path& out, bool& force, bool& quiet) {
  app.add_option("--out", out, fmt::format("folder for the results [{}]", out.string()))->type_name("DIR");
  app.add_flag("--force", force, "replace results that are there");
  app.add_flag("--quiet", quiet, "errors only");
}

Material shipped_material(const std::string& name, const std::string& program) {
  MaterialLayers layers;
  layers.preset = read_preset(name, program, shipped_data()).layer;
  return make_material(material_base(layers), {}, Elasticity::paper, name);
}

}  // namespace breccia
