// One declaration per key of a case: reading, checks, unknown keys, the resolved case and the
// printed reference all derive from it.
#pragma once
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/loading/laboratory_tests.hpp"
#include "io/cases/case.hpp"
#include "io/text/units.hpp"

namespace breccia {

/// What stands behind the equals sign.
enum class Kind { quantity, quantities, whole_number, boolean, word, text, word_or_number };

/// A value taken off its key: which member counts follows from the key's kind.
struct Reading {
  double number = 0;            ///< quantity; word_or_number that is a number
  std::int64_t whole = 0;       ///< whole number
  std::vector<double> numbers;  ///< quantities
  std::string word;             ///< word, text; word_or_number: empty when it is the number
  bool flag = false;            ///< boolean
};

struct Range {
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  bool low_open = false, high_open = false;
};

/// Where another key has a certain value, a range is narrower.
struct RangeWhere {
  std::string_view key, value;
  Range range;
};

/// One key of a case. Words are separated by blanks.
struct Key {
  std::string_view name;  ///< with its table: "test.platen_speed"
  Kind kind = Kind::quantity;
  Dimension dimension{};
  std::string_view default_text{};  ///< the default as one writes it; empty: none
  /// where a test has another default, or none (an empty one)
  std::optional<std::string_view> (*default_of)(const LaboratoryTest&) = nullptr;
  std::string_view default_2d{};  ///< where a 2-D scene has another and the test has none
  Range range{};
  RangeWhere where{};
  std::string_view words{};                             ///< valid words
  std::size_t count = 0;                                ///< of quantities; 0: one or more
  bool rising = false;                                  ///< quantities never fall
  std::string_view instead_of{};                        ///< the key that this one replaces
  bool (*refused_by)(const LaboratoryTest&) = nullptr;  ///< a test that has no use for it
  bool packs = true;                                    ///< breccia-pack accepts it
  std::string_view reason{};                            ///< why it is refused
  std::string_view meaning{};
  std::string_view law{};  ///< a parameter that this law alone has
  void (*store)(Case&, const Reading&) = nullptr;
  void (*store_material)(Material&, const Reading&) = nullptr;
};

/// Every key, in the order in which the resolved case lists them.
std::span<const Key> all_keys();
/// The declaration of a key by its full name, or nullptr.
const Key* find_key(std::string_view name);
/// Names of the keys that the test accepts; of one table only if `table` is not empty.
std::vector<std::string> key_names(std::string_view test, std::string_view table = {});
/// The keys that exclude this one (fracture energy or damage, range or coordination).
std::vector<const Key*> rivals(const Key&);

/// Whether a program is none of the laboratory tests: breccia-pack, which takes a specimen alone.
bool takes_specimen_only(std::string_view program);
/// @param program  "ucs", ..., "pack"
bool accepts(const Key&, std::string_view program);
std::string_view default_text_of(const Key&, std::string_view test, Space space = Space::three_d);
std::vector<std::string> split_words(std::string_view words);

/// "from 0 to below 0.5", "more than 0 Pa"; empty when anything goes.
std::string describe(const Range&, Dimension);

}  // namespace breccia
