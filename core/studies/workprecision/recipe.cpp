#include "core/studies/workprecision/recipe.hpp"

#include <fmt/format.h>

namespace breccia {

std::string describe(const Recipe& r) {
  const std::string damping = r.damping.translation == r.damping.rotation
                                  ? fmt::format("{}", r.damping.translation)
                                  : fmt::format("{}/{}", r.damping.translation, r.damping.rotation);
  return fmt::format("step {}, {} m/s, {}, mass {}, damping {}, {}, {}", r.safety, r.platen_speed,
                     name_of(r.scheme), r.mass_factor, damping, name_of(r.precision), name_of(r.scatter));
}

std::string case_lines(const Recipe& r) {
  const std::string masses = r.mass_factor > 1.0
                                 ? fmt::format("mass_scaling = true\nmass_factor = {}", r.mass_factor)
                                 : "mass_scaling = false";
  return fmt::format(
      "[test]\nplaten_speed = \"{} m/s\"\n\n[time]\nsafety = {}\n{}\n\n[damping]\nscheme = "
      "\"{}\"\ntranslation = "
      "{}\nrotation = {}\n\n[run]\nprecision = \"{}\"\nscatter = \"{}\"\n",
      r.platen_speed, r.safety, masses, name_of(r.scheme), r.damping.translation, r.damping.rotation,
      name_of(r.precision), name_of(r.scatter));
}

double steps_over(const Recipe& recipe, const Recipe& other) {
  const auto pace = [](const Recipe& r) { return r.safety * r.platen_speed; };
  return pace(other) / pace(recipe);
}

}  // namespace breccia
