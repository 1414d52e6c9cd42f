// The words by which users know the ways of summing forces.
#pragma once
#include <string_view>

#include "core/base/scene_options.hpp"

namespace breccia {

constexpr std::string_view name_of(ScatterKind scatter) {
  switch (scatter) {
    case ScatterKind::atomic:
      return "atomic";
    case ScatterKind::private_sums:
      return "private";
    case ScatterKind::gather:
      return "gather";
  }
  return "?";
}

}  // namespace breccia
