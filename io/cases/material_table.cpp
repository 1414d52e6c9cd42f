#include "io/cases/material_table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace breccia {
namespace {

/// The material where the table names a confinement.
struct Node {
  double confinement = 0;
  Layer layer;
};

double between(double low, double high, double part) { return (1.0 - part) * low + part * high; }

bool is_numeric(const Key& key) { return key.kind == Kind::quantity || key.kind == Kind::quantities; }

/// Straight lines between the numbers of two layers. What only one of them has is taken from it.
Layer between(const Node& low, const Node& high, double part) {
  Layer result = low.layer;
  for (const auto& [name, given] : high.layer) {
    const Key& key = *find_key(name);
    for (const Key* other : rivals(key))
      if (!low.layer.contains(name) && low.layer.contains(other->name))
        refuse(
            given.place, name,
            fmt::format("stands at {}, and {} at {}: nothing lies between the two; give the same one at both",
                        format_quantity(high.confinement, dimension::stress), other->name,
                        format_quantity(low.confinement, dimension::stress)));
    const auto below = result.find(name);
    if (below == result.end()) {
      result[name] = given;
      continue;
    }
    if (!is_numeric(key)) continue;
    Reading& reading = below->second.reading;
    reading.number = between(reading.number, given.reading.number, part);
    for (std::size_t k = 0; k < reading.numbers.size(); ++k)
      reading.numbers[k] = between(reading.numbers[k], given.reading.numbers[k], part);
    if (!given.place.empty()) below->second.place = given.place;
  }
  return result;
}

/// The nodes around a confinement, and how far it lies between them.
struct Place {
  std::size_t low = 0, high = 0;
  double part = 0;
};

Place place_of(const std::vector<Node>& nodes, double confinement) {
  for (std::size_t k = 0; k < nodes.size(); ++k)
    if (same_confinement(nodes[k].confinement, confinement)) return {k, k};
  const auto above = std::find_if(nodes.begin(), nodes.end(),
                                  [&](const Node& node) { return node.confinement > confinement; });
  const auto high = static_cast<std::size_t>(above - nodes.begin());
  if (above == nodes.end()) return {high - 1, high - 1};
  const double from = nodes[high - 1].confinement;
  return {high - 1, high, (confinement - from) / (above->confinement - from)};
}

Layer layer_at(const std::vector<Node>& nodes, const Place& at) {
  return at.low == at.high ? nodes[at.low].layer : between(nodes[at.low], nodes[at.high], at.part);
}

/// Confinements that the tables name, and zero, rising.
std::vector<double> confinements_of(const std::vector<const std::vector<ConfinementLayer>*>& tables) {
  std::vector<double> all{0.0};
  for (const auto* table : tables)
    for (const ConfinementLayer& group : *table)
      if (std::none_of(all.begin(), all.end(),
                       [&](double p) { return same_confinement(p, group.confinement); }))
        all.push_back(group.confinement);
  std::sort(all.begin(), all.end());
  return all;
}

std::vector<Node> nodes_of_preset(const MaterialLayers& m) {
  std::vector<Node> nodes;
  for (const double p : confinements_of({&m.preset_at})) {
    nodes.push_back({p, m.preset});
    if (const Layer* at = find_confinement(m.preset_at, p)) lay_over(nodes.back().layer, *at);
  }
  return nodes;
}

std::vector<Node> nodes_of(const MaterialLayers& m) {
  const std::vector<Node> preset = nodes_of_preset(m);
  std::vector<Node> nodes;
  for (const double p : confinements_of({&m.preset_at, &m.given_at})) {
    const Layer below = layer_at(preset, place_of(preset, p));
    nodes.push_back({p, laid(m, &below, find_confinement(m.given_at, p))});
  }
  return nodes;
}

/// Keys that are not the same at all nodes.
std::vector<const Key*> varying_keys(const std::vector<Node>& nodes) {
  std::vector<const Key*> varying;
  for (const Key& key : all_keys()) {
    const auto text_at = [&](const Node& node) {
      const auto given = node.layer.find(key.name);
      return given == node.layer.end() ? std::string() : write_value(key, given->second.reading);
    };
    const std::string first = text_at(nodes.front());
    if (std::any_of(nodes.begin(), nodes.end(), [&](const Node& node) { return text_at(node) != first; }))
      varying.push_back(&key);
  }
  return varying;
}

std::string pressure(double p) { return fmt::format("{:.4g} MPa", p * 1e-6); }

}  // namespace

MaterialAt material_at(const MaterialLayers& m, double confinement) {
  const std::vector<Node> nodes = nodes_of(m);
  const Place at = place_of(nodes, confinement);
  MaterialAt found;
  found.layer = layer_at(nodes, at);
  const double low = nodes[at.low].confinement, high = nodes[at.high].confinement;
  found.used = {low, high};
  const std::vector<const Key*> varying = varying_keys(nodes);
  if (varying.empty()) return found;
  if (at.low != at.high)
    found.from = fmt::format("between those at {} and {}", pressure(low), pressure(high));
  else
    found.from = fmt::format("those at {}", pressure(low));
  if (!same_confinement(low, confinement) && at.low == at.high)
    found.warning = fmt::format(
        "the material's table ends at {}, below this confinement: its last values are used", pressure(low));
  for (const Key* key : varying)
    if (found.layer.contains(key->name) && !nodes[at.low].layer.contains(key->name) && rivals(*key).empty())
      found.warning = fmt::format("the material's table has no {} below {}: its first values are used",
                                  key->name.substr(std::string_view("material.").size()), pressure(high));
  return found;
}

std::string describe_varying(const MaterialLayers& m, const Layer& at) {
  std::string text;
  for (const Key* key : varying_keys(nodes_of(m)))
    if (const auto given = at.find(key->name); given != at.end())
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ",
                          key->name.substr(std::string_view("material.").size()),
                          write_value(*key, given->second.reading));
  return text;
}

}  // namespace breccia
