#include "core/tables/column.hpp"

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
    case Role::ledger:
      return "ledger";
    case Role::derived:
      return "derived";
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
    case Need::strength_area:
      return "strength area of its own";
    case Need::ledger:
      return "energy ledger";
    case Need::rolling:
      return "rolling friction";
    case Need::several:
      return "several materials";
    case Need::single:
      return "single precision";
    case Need::hertz:
      return "Hertz contacts";
    case Need::orientation:
      return "orientation";
    case Need::stress:
      return "stress output";
  }
  return "?";
}

}  // namespace breccia
