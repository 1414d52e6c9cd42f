// The keys of a case in print, made from their declarations: for --help, and
// docs/case-reference.md.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "io/cases/keys_schema.hpp"

namespace breccia {

/// A default that holds under a condition only.
struct ConditionalDefault {
  std::string kind, of;  ///< "in" "2-D", "law" "kdem", "accuracy" "fast"
  std::string_view value;
};

/// What a key gets, where the case does not name it, other than its usual default: in 2-D where
/// that is not what the test has anyway, with a bond law, with a recipe of time.accuracy.
/// @param test  "ucs", ...; a 2-D default that this test never has is left out
std::vector<ConditionalDefault> conditional_defaults(const Key& key, std::string_view test);

/// The keys that a test accepts, one a line: name, what is valid, default, meaning. For `--help`.
std::string describe_keys(const std::string& test);

/// Every key of a laboratory test and of breccia-pack as tables in markdown: name, what is valid,
/// default with all its conditions, programs or laws that take it, meaning.
std::string case_reference();

}  // namespace breccia
