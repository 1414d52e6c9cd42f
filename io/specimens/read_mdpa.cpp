#include "io/specimens/read_mdpa.hpp"

#include <algorithm>
#include <array>
#include <unordered_map>

#include "core/base/error.hpp"
#include "io/text/suggest.hpp"
#include "io/text/text_file.hpp"

namespace breccia {
namespace {

using Fields = std::array<std::string_view, 8>;

/// Splits at blanks; fields beyond the eighth are counted and dropped.
std::size_t split(std::string_view line, Fields& fields) {
  std::size_t count = 0;
  for (line = trim(line); !line.empty(); line = trim(line)) {
    const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
    if (count < fields.size()) fields[count] = line.substr(0, end);
    ++count;
    line.remove_prefix(end);
  }
  return count;
}

/// Next line that is not empty once its comment is off.
bool next_line(LineReader& reader, std::string_view& line) {
  while (reader.next(line)) {
    line = trim(line.substr(0, line.find("//")));
    if (!line.empty()) return true;
  }
  return false;
}

struct Model {
  std::unordered_map<Gid, std::size_t> row;  ///< of a node, by its id
  std::vector<SpecimenSphere> nodes;
  std::vector<bool> has_radius, has_group;
  struct Element {
    Gid node = 0;
    std::size_t line = 0;
  };
  std::vector<Element> elements;
  bool groups = false;
};

void want(std::size_t count, std::size_t least, const char* what, const LineReader& reader) {
  if (count < least) fail<BadInput>("{}: {} fields; {} are wanted: {}", reader.place(), count, least, what);
}

std::size_t row_of(const Model& model, std::string_view field, const LineReader& reader) {
  const auto at = model.row.find(to_id(field, "node", reader));
  if (at == model.row.end()) fail<BadInput>("{}: there is no node {}", reader.place(), quote(field));
  return at->second;
}

void read_node(Model& model, const Fields& fields, std::size_t count, const LineReader& reader) {
  want(count, 4, "node x y z", reader);
  SpecimenSphere& node = model.nodes.emplace_back();
  node.id = to_id(fields[0], "node", reader);
  node.centre = {to_number(fields[1], "x", reader), to_number(fields[2], "y", reader),
                 to_number(fields[3], "z", reader)};
  node.line = reader.line_number();
  const auto [at, is_new] = model.row.emplace(node.id, model.nodes.size() - 1);
  if (!is_new)
    fail<BadInput>("{}: node {} is also in line {}", reader.place(), node.id, model.nodes[at->second].line);
  model.has_radius.push_back(false);
  model.has_group.push_back(false);
}

void read_radius(Model& model, const Fields& fields, std::size_t count, const LineReader& reader) {
  want(count, 3, "node fixed radius", reader);
  const std::size_t row = row_of(model, fields[0], reader);
  model.nodes[row].radius = to_number(fields[2], "radius", reader);
  model.has_radius[row] = true;
}

void read_group(Model& model, const Fields& fields, std::size_t count, const LineReader& reader) {
  want(count, 3, "node fixed group", reader);
  const std::size_t row = row_of(model, fields[0], reader);
  model.nodes[row].group = to_group(fields[2], reader);
  model.has_group[row] = true;
}

void read_element(Model& model, const Fields& fields, std::size_t count, const LineReader& reader) {
  want(count, 3, "element properties node", reader);
  model.elements.push_back({to_id(fields[2], "node", reader), reader.line_number()});
}

enum class Block { other, nodes, spheres, radius, group };

Block block_of(const Fields& fields, std::size_t count) {
  if (count >= 2 && fields[1] == "Nodes") return Block::nodes;
  if (count < 3) return Block::other;
  if (fields[1] == "Elements" && fields[2].find("Spheric") != std::string_view::npos) return Block::spheres;
  if (fields[1] == "NodalData" && fields[2] == "RADIUS") return Block::radius;
  if (fields[1] == "NodalData" && fields[2] == "COHESIVE_GROUP") return Block::group;
  return Block::other;
}

/// Reads to the end of a block that has begun; blocks within others say nothing about spheres.
void read_block(Model& model, LineReader& reader, Block block, const std::string& begin) {
  Fields fields;
  std::string_view line;
  std::vector<std::string> within;  // places where blocks within this one begin
  while (next_line(reader, line)) {
    const std::size_t count = split(line, fields);
    if (fields[0] == "End") {
      if (within.empty()) return;
      within.pop_back();
      continue;
    }
    if (fields[0] == "Begin") {
      within.push_back(reader.place());
      continue;
    }
    switch (within.empty() ? block : Block::other) {
      case Block::nodes:
        read_node(model, fields, count, reader);
        break;
      case Block::radius:
        read_radius(model, fields, count, reader);
        break;
      case Block::group:
        read_group(model, fields, count, reader);
        break;
      case Block::spheres:
        read_element(model, fields, count, reader);
        break;
      case Block::other:
        break;
    }
  }
  fail<BadInput>("{}: this block has no End", within.empty() ? begin : within.back());
}

std::vector<SpecimenSphere> spheres_of(const Model& model, const std::string& name) {
  std::vector<SpecimenSphere> spheres;
  spheres.reserve(model.elements.size());
  for (const auto& [node, line] : model.elements) {
    const auto at = model.row.find(node);
    if (at == model.row.end()) fail<BadInput>("{}:{}: there is no node {}", name, line, node);
    if (!model.has_radius[at->second])
      fail<BadInput>("{}:{}: node {} has no RADIUS in NodalData", name, line, node);
    SpecimenSphere sphere = model.nodes[at->second];
    if (!model.has_group[at->second]) sphere.group = model.groups ? 0 : 1;
    spheres.push_back(sphere);
  }
  return spheres;
}

}  // namespace

std::vector<SpecimenSphere> spheres_from_mdpa(const std::string& name, std::string_view text) {
  LineReader reader(name, text);
  Model model;
  Fields fields;
  std::string_view line;
  while (next_line(reader, line)) {
    const std::size_t count = split(line, fields);
    if (fields[0] != "Begin") fail<BadInput>("{}: {} stands outside any block", reader.place(), quote(line));
    const Block block = block_of(fields, count);
    if (block == Block::group) model.groups = true;
    read_block(model, reader, block, reader.place());
  }
  return spheres_of(model, name);
}

}  // namespace breccia
