// A Vec3 in one register: its three numbers and what fills it up to 32 bytes.
#pragma once
#include "kernels/math/vec3.hpp"

namespace breccia {
namespace {  // internal linkage: what is built for wide registers is never linked into code that runs without
             // them

using Four [[gnu::vector_size(32), gnu::may_alias]] = double;

[[gnu::always_inline]] inline Four& four(Vec3& row) { return reinterpret_cast<Four&>(row); }
[[gnu::always_inline]] inline const Four& four(const Vec3& row) { return reinterpret_cast<const Four&>(row); }

}  // namespace
}  // namespace breccia
