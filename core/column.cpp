#include "core/column.hpp"

namespace breccia {

std::string_view name_of(Role role) {
  switch (role) {
    case Role::identity:
      return "identity";
    case Role::reference:
      return "reference";
    case Role::history:
      return "history";
    case Role::state:
      return "state";
    case Role::scratch:
      return "scratch";
  }
  return "?";
}

std::string_view name_of(Need need) {
  switch (need) {
    case Need::always:
      return "always";
    case Need::rotation:
      return "rotation";
    case Need::contact_damping:
      return "contact damping";
    case Need::plasticity:
      return "plasticity";
    case Need::breakage:
      return "breakage";
  }
  return "?";
}

}  // namespace breccia
