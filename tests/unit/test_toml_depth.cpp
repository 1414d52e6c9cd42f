#include <doctest/doctest.h>

#include <string>

#include "io/text/toml_depth.hpp"

using namespace breccia;

namespace {

std::string repeated(std::string_view text, std::size_t count) {
  std::string result;
  for (std::size_t k = 0; k < count; ++k) result += text;
  return result;
}

}  // namespace

TEST_CASE("Dotted keys and brackets are counted up to the limit") {
  const std::string most = repeated("a.", deepest_toml - 1) + "a", more = "a." + most;
  CHECK_FALSE(line_nested_too_deep("[" + most + "]\n" + most + " = 1\n"));
  CHECK(line_nested_too_deep("x = 1\n" + more + " = 1\n") == 2);
  CHECK(line_nested_too_deep("[" + more + "]\n") == 1);
  CHECK(line_nested_too_deep("x = { " + more + " = 1 }\n") == 1);
  CHECK_FALSE(line_nested_too_deep("x = " + repeated("[", deepest_toml) + repeated("]", deepest_toml)));
  CHECK(line_nested_too_deep("x = [\n" + repeated("[", deepest_toml)) == 2);
  CHECK(line_nested_too_deep("x = " + repeated("{a = [", deepest_toml)) == 1);
  CHECK_FALSE(line_nested_too_deep(repeated("x = [1.5, [2.5, 3.5]]\n", 1000)));
}

TEST_CASE("What stands in strings and comments is no nesting") {
  const std::string dots = repeated(".", 100), brackets = repeated("[", 100);
  for (const std::string& text :
       {"# " + dots + brackets, "x = \"" + dots + "\\\"" + brackets + "\"", "x = '" + dots + "\\'",
        "x = \"\"\"\n" + dots + "\"\"\n\"" + brackets + "\"\"\"\"\"",
        "x = '''\n" + dots + "''" + brackets + "'''"}) {
    CAPTURE(text);
    CHECK_FALSE(line_nested_too_deep(text));
    CHECK(line_nested_too_deep(text + "\n" + brackets).has_value());  // the string has its end there
  }
  CHECK(line_nested_too_deep("x = '''\n\n'''\ny = \"\"\ny = " + brackets) == 5);
  CHECK_FALSE(line_nested_too_deep("x = \"\"\"" + dots));  // without an end: for the parser to say
}
