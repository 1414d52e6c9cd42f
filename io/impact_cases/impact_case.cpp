#include "io/impact_cases/impact_case.hpp"

#include <algorithm>
#include <charconv>

#include "core/base/error.hpp"
#include "io/cases/keys_value.hpp"
#include "io/cases/keys_write.hpp"
#include "io/impact_cases/impact_keys.hpp"
#include "io/specimens/read_specimen.hpp"
#include "io/text/suggest.hpp"
#include "io/text/text_file.hpp"
#include "io/text/toml_depth.hpp"

namespace breccia {
namespace {

constexpr std::string_view program = "impact";
const std::vector<std::string> tables{"materials", "particle", "spheres", "wall",
                                      "contact",   "scene",    "time",    "output"};

std::string_view table_of(const Key& key) { return key.name.substr(0, key.name.find('.')); }
std::string_view word_of(const Key& key) { return key.name.substr(key.name.find('.') + 1); }

TomlNode* find_entry(TomlTable& table, std::string_view name) {
  const auto at =
      std::find_if(table.begin(), table.end(), [&](const TomlEntry& entry) { return entry.name == name; });
  return at == table.end() ? nullptr : &at->node;
}

// --- --set: the value takes its place in the tree before anything is read

/// The table that a --set goes on to: by name in a table, by number from 1 in a list of tables.
TomlNode& descend(TomlNode& node, const std::string& word, const std::string& whole) {
  if (auto* table = std::get_if<TomlTable>(&node.value)) {
    if (TomlNode* found = find_entry(*table, word)) return *found;
    table->push_back({word, TomlNode{TomlTable{}, "--set", 0}});
    return table->back().node;
  }
  if (auto* list = std::get_if<TomlArray>(&node.value)) {
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error == std::errc{} && end == word.data() + word.size() && number >= 1 && number <= list->size())
      return (*list)[number - 1];
    refuse("--set", whole, fmt::format("{} is not a number from 1 to {}", quote(word), list->size()));
  }
  refuse("--set", whole, fmt::format("{} is below a key that is no table", quote(word)));
}

void apply_set(TomlNode& root, const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string name(trim(std::string_view(text).substr(0, equals)));
  if (equals == std::string::npos || name.find('.') == std::string::npos)
    fail<BadInput>("--set: {}: write --set table.key=value", quote(text));
  if (line_nested_too_deep(name))
    fail<BadInput>("--set: {}: nested more than {} deep", quote(name), deepest_toml);
  TomlNode* node = &root;
  std::size_t from = 0;
  for (std::size_t dot; (dot = name.find('.', from)) != std::string::npos; from = dot + 1)
    node = &descend(*node, name.substr(from, dot - from), name);
  auto* table = std::get_if<TomlTable>(&node->value);
  if (!table) refuse("--set", name, "is not a key of a table; particles and walls have a number from 1");
  const std::string word = name.substr(from);
  TomlNode value = parse_toml_value(text.substr(equals + 1), "--set");
  if (TomlNode* found = find_entry(*table, word))
    *found = std::move(value);
  else
    table->push_back({word, std::move(value)});
}

// --- one table, by the declarations of its keys

Reading standard_reading(const Key& key) {
  if (key.kind != Kind::quantities) return read_default(key, program);
  Reading reading;
  for (const std::string& number : split_words(key.default_text))
    reading.numbers.push_back(std::stod(number));
  return reading;
}

template <class T>
bool belongs(const Field<T>& field, const std::string& kind) {
  const auto kinds = split_words(field.kinds);
  return kinds.empty() || std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

/// "10 Hz" is ten turns a second to some, ten radians to others.
void refuse_hertz(const Key& key, const TomlNode& node) {
  if (const auto* text = std::get_if<std::string>(&node.value))
    if (text->find("Hz") != std::string::npos)
      refuse(node.place, key.name, fmt::format("{}: write rad/s", quote(*text)));
  if (const auto* list = std::get_if<TomlArray>(&node.value))
    for (const TomlNode& entry : *list) refuse_hertz(key, entry);
}

/// Reads a table into `row` and returns its resolved lines.
/// @param fields  of one table, "table.word"
/// @param kind    of the wall; empty otherwise
template <class T>
std::string read_fields(const std::vector<const Field<T>*>& fields, const TomlTable& table,
                        const std::string& place, const std::string& kind, T& row) {
  std::vector<std::string> words;
  for (const Field<T>* field : fields) words.emplace_back(word_of(field->key));
  const std::string prefix(table_of(fields.front()->key));
  std::vector<const TomlNode*> nodes(fields.size(), nullptr);
  for (const auto& [word, node] : table) {
    const auto at = std::find(words.begin(), words.end(), word);
    if (at == words.end()) refuse(node.place, prefix + "." + word, "unknown key; " + suggest(word, words));
    const auto k = static_cast<std::size_t>(at - words.begin());
    if (!belongs(*fields[k], kind))
      refuse(node.place, fields[k]->key.name,
             fmt::format("belongs to kind {}; leave it out", quote_list(split_words(fields[k]->kinds))));
    nodes[k] = &node;
  }
  std::string lines;
  for (std::size_t k = 0; k < fields.size(); ++k) {
    const Field<T>& field = *fields[k];
    if (!belongs(field, kind)) continue;
    if (!nodes[k] && field.required)
      refuse(place, field.key.name, fmt::format("missing; {}", describe_values(field.key)));
    if (!nodes[k] && field.key.default_text.empty()) continue;
    if (nodes[k] && field.key.dimension == Dimension{0, 0, -1}) refuse_hertz(field.key, *nodes[k]);
    const Reading reading = nodes[k] ? read_value(field.key, *nodes[k]) : standard_reading(field.key);
    field.store(row, reading);
    lines += fmt::format("{} = {}\n", words[k], write_value(field.key, reading));
  }
  return lines;
}

template <class T>
std::vector<const Field<T>*> all_of(std::span<const Field<T>> fields, std::string_view table = {}) {
  std::vector<const Field<T>*> result;
  for (const Field<T>& field : fields)
    if (table.empty() || table_of(field.key) == table) result.push_back(&field);
  return result;
}

const TomlTable& as_table(const TomlNode& node, std::string_view name, const std::string& written) {
  const auto* table = std::get_if<TomlTable>(&node.value);
  if (!table) refuse(node.place, name, fmt::format("a table is wanted: {}", written));
  return *table;
}

const TomlArray& as_list(const TomlNode& node, std::string_view name) {
  const auto* list = std::get_if<TomlArray>(&node.value);
  if (!list) refuse(node.place, name, fmt::format("write [[{}]], once for each", name));
  return *list;
}

// --- the whole case

struct Reader {
  const TomlTable& root;
  std::string file;
  ImpactCase result{};

  const TomlNode* find(std::string_view name) const {
    const auto at =
        std::find_if(root.begin(), root.end(), [&](const TomlEntry& entry) { return entry.name == name; });
    return at == root.end() ? nullptr : &at->node;
  }

  void tables_known() const {
    for (const auto& [word, node] : root)
      if (std::find(tables.begin(), tables.end(), word) == tables.end())
        refuse(node.place, word, "unknown table; " + suggest(word, tables));
  }

  void scene() {
    const auto fields = scene_fields();
    for (const std::string_view table : {"contact", "scene", "time", "output"}) {
      const TomlNode* node = find(table);
      const TomlTable empty;
      const std::string lines = read_fields(all_of(fields, table),
                                            node ? as_table(*node, table, fmt::format("[{}]", table)) : empty,
                                            node ? node->place : file, "", result.scene);
      result.resolved += fmt::format("\n[{}]\n{}", table, lines);
    }
    const ImpactScene& s = result.scene;
    if (s.stiffness && s.law != ContactLaw::linear)
      refuse(find("contact")->place, "contact.stiffness", "belongs to law = \"linear\"; leave it out");
  }

  void materials() {
    const TomlNode* node = find("materials");
    if (!node)
      refuse(file, "materials", "missing; write [materials.NAME] with young_modulus and poisson_ratio");
    for (const auto& [name, child] : as_table(*node, "materials", "[materials.NAME]")) {
      const std::string lines =
          read_fields(all_of(material_fields()), as_table(child, "materials." + name, "[materials.NAME]"),
                      child.place, "", result.scene.materials.emplace_back());
      result.material_names.push_back(name);
      result.resolved += fmt::format("\n[materials.{}]\n{}", toml_string(name), lines);
    }
  }

  std::size_t material_of(const std::string& name, std::string_view key, const TomlNode& entry) const {
    const auto& names = result.material_names;
    const auto at = std::find(names.begin(), names.end(), name);
    if (at == names.end())
      refuse(entry.place, key, fmt::format("no [materials.{}]; {}", name, suggest(name, names)));
    return static_cast<std::size_t>(at - names.begin());
  }

  std::size_t heavy_material_of(const std::string& name, std::string_view key, const TomlNode& entry) const {
    const std::size_t material = material_of(name, key, entry);
    if (!(result.scene.materials[material].density > 0.0))
      refuse(entry.place, key, fmt::format("[materials.{}] has no density; give it one", name));
    return material;
  }

  /// Particles of a file may overlap a little, as those of a heap at rest do.
  void spheres() {
    const TomlNode* node = find("spheres");
    if (!node) return;
    constexpr double settled = 0.05;
    SpheresEntry s;
    const std::string lines =
        read_fields(all_of(spheres_fields()), as_table(*node, "spheres", "[spheres]"), node->place, "", s);
    const std::size_t material = heavy_material_of(s.material, "spheres.material", *node);
    check_specimen_type(s.file);
    for (const SpecimenSphere& sphere : read_specimen(s.file).spheres)
      result.scene.particles.push_back({sphere.centre, s.velocity, s.spin, sphere.radius, material, settled});
    result.spheres_file = s.file;
    result.resolved += "\n[spheres]\n" + lines;
  }

  void particles() {
    const TomlNode* node = find("particle");
    if (!node) {
      if (!find("spheres"))
        refuse(file, "particle", "missing; write [[particle]], once for each, or [spheres] with a file");
      return;
    }
    for (const TomlNode& entry : as_list(*node, "particle")) {
      ParticleEntry p;
      const std::string lines = read_fields(all_of(particle_fields()),
                                            as_table(entry, "particle", "[[particle]]"), entry.place, "", p);
      p.particle.material = heavy_material_of(p.material, "particle.material", entry);
      result.scene.particles.push_back(p.particle);
      result.resolved += "\n[[particle]]\n" + lines;
    }
    if (result.scene.particles.empty())
      refuse(node->place, "particle", "the list is empty; give one or more");
  }

  /// Directions get unit length; a wall without extent is refused.
  void finish(Wall& wall, const TomlNode& entry) const {
    if (wall.kind == WallKind::triangle)
      wall.direction = cross(wall.second - wall.point, wall.third - wall.point);
    const double length = norm(wall.direction);
    if (!(length > 0.0))
      refuse(entry.place, "wall",
             wall.kind == WallKind::triangle ? "the three corners lie on one line"
                                             : "a direction has no length");
    wall.direction = (1.0 / length) * wall.direction;
  }

  /// A motion that says nothing, or another one than that of the walls of the same name.
  void check_motion(const WallEntry& w, const TomlTable& table, const TomlNode& entry) const {
    const WallMotion& m = w.wall.motion;
    for (const auto& [word, node] : table) {
      if ((word == "starts" || word == "stops") && !m.moves())
        refuse(node.place, "wall." + word,
               "the wall does not move; give it a velocity or a spin, or leave it out");
      if (word == "stops" && !(m.stop > m.start))
        refuse(node.place, "wall.stops", "must be later than wall.starts");
      if (word == "starts" && !(m.start < result.scene.duration))
        refuse(node.place, "wall.starts",
               fmt::format("is not before the end, time.duration = {} s", result.scene.duration));
      if (word == "name" && (w.name.empty() || w.name.find_first_of(",\"\n\r") != std::string::npos))
        refuse(node.place, "wall.name", "one or more characters, no comma, quote or line end");
    }
    if ((w.wall.load > 0.0) != (w.wall.mass > 0.0))
      refuse(entry.place, w.wall.load > 0.0 ? "wall.mass" : "wall.load",
             "missing; a plane that gives way has both, a mass and a load");
    for (const ImpactWall& other : result.scene.walls)
      if (other.name == w.wall.name && !(other.motion == m))
        refuse(entry.place, "wall.name",
               fmt::format("another wall {} moves otherwise; walls of one name are one body", quote(w.name)));
  }

  /// The number of a name, a new one if it is.
  std::size_t number_of(const std::string& name) {
    auto& names = result.scene.wall_names;
    const auto at = std::find(names.begin(), names.end(), name);
    if (at == names.end()) names.push_back(name);
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  }

  void walls() {
    const TomlNode* node = find("wall");
    if (!node) return;
    for (const TomlNode& entry : as_list(*node, "wall")) {
      WallEntry w;
      const TomlTable& table = as_table(entry, "wall", "[[wall]]");
      const Key& kind = wall_fields().front().key;
      const auto given =
          std::find_if(table.begin(), table.end(), [](const auto& e) { return e.name == "kind"; });
      if (given == table.end())
        refuse(entry.place, kind.name, fmt::format("missing; {}", describe_values(kind)));
      const std::string word = read_value(kind, given->node).word;
      const std::string lines = read_fields(all_of(wall_fields()), table, entry.place, word, w);
      w.wall.shape.kind = word == "plane"      ? WallKind::plane
                          : word == "cylinder" ? WallKind::cylinder
                                               : WallKind::triangle;
      finish(w.wall.shape, entry);
      w.wall.material = material_of(w.material, "wall.material", entry);
      if (w.name.empty()) w.name = fmt::format("wall-{}", result.scene.walls.size() + 1);
      w.wall.name = number_of(w.name);
      check_motion(w, table, entry);
      result.scene.walls.push_back(w.wall);
      result.resolved += "\n[[wall]]\n" + lines;
    }
  }

  /// "file:line" of a key, of its table, or the file.
  std::string place_of(const std::string& key, std::size_t entry) const {
    const TomlNode* node = find(key.substr(0, key.find('.')));
    if (!node) return file;
    if (const auto* list = std::get_if<TomlArray>(&node->value))
      node = entry < list->size() ? &(*list)[entry] : node;
    if (const auto* table = std::get_if<TomlTable>(&node->value))
      for (const auto& [word, child] : *table)
        if (word == key.substr(key.find('.') + 1)) return child.place;
    return node->place.empty() ? file : node->place;
  }

  /// A request that nothing can come of.
  void idle() const {
    const ImpactScene& s = result.scene;
    if (s.law == ContactLaw::linear && s.form == HertzForm::classic)
      refuse(place_of("contact.form", 0), "contact.form", "belongs to law = \"hertz-mindlin\"; leave it out");
    for (std::size_t k = 0; k < result.material_names.size(); ++k) {
      const auto has = [&](const auto& one) { return one.material == k; };
      if (std::any_of(s.particles.begin(), s.particles.end(), has) ||
          std::any_of(s.walls.begin(), s.walls.end(), has))
        continue;
      const std::string key = "materials." + result.material_names[k];
      refuse(place_of(key, 0), key, "no particle or wall is of it; leave it out");
    }
  }

  /// What only the whole scene tells.
  void start() const {
    try {
      check_start(result.scene);
      impact_steps(result.scene, critical_impact_step(result.scene));
    } catch (const BadScene& bad) {
      refuse(place_of(bad.key, bad.entry), bad.key, bad.what());
    }
  }
};

template <class T>
void describe_fields(std::string& text, std::span<const Field<T>> fields, std::string_view left,
                     std::string_view right) {
  std::string_view table;
  for (const Field<T>& field : fields) {
    const Key& key = field.key;
    if (table_of(key) != table) table = table_of(key), text += fmt::format("\n{}{}{}\n", left, table, right);
    const std::string of = field.kinds.empty() ? "" : fmt::format("{}: ", field.kinds);
    text += fmt::format("  {:<17} {:<44} {:<16} {}{}\n", word_of(key), describe_values(key),
                        key.default_text.empty() ? "-" : key.default_text, of, key.meaning);
  }
}

}  // namespace

ImpactCase load_impact_case(const std::filesystem::path& file, const std::vector<std::string>& sets) {
  TomlNode root = read_toml(file);
  for (const std::string& set : sets) apply_set(root, set);
  Reader reader{std::get<TomlTable>(root.value), file.string()};
  reader.result.resolved = "# breccia-impact: the case with every default written out\n";
  reader.tables_known();
  reader.scene();
  reader.materials();
  reader.particles();
  reader.spheres();
  reader.walls();
  reader.idle();
  reader.start();
  return std::move(reader.result);
}

std::string describe_impact_keys() {
  std::string text =
      "keys of a case for breccia-impact (a quantity: \"3.8 GPa\", or a bare number in SI)\n"
      "--set materials.NAME.restitution=0.5, --set particle.2.spin=[0, 0, 1]: particles and walls count from "
      "1\n";
  describe_fields(text, scene_fields(), "[", "]");
  describe_fields(text, material_fields(), "[", ".NAME]");
  describe_fields(text, particle_fields(), "[[", "]]");
  describe_fields(text, spheres_fields(), "[", "]");
  describe_fields(text, wall_fields(), "[[", "]]");
  return text;
}

}  // namespace breccia
