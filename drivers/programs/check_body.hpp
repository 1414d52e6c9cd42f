// The spheres of a specimen against the nominal body that the case gives: stresses, strains and
// pressure use the nominal one, so that they are wrong where it is not the body that is there.
#pragma once
#include <string>
#include <vector>

#include "core/bonding/pieces.hpp"
#include "io/cases/case.hpp"
#include "io/results/progress.hpp"

namespace breccia {

/// @param placed   the specimen, axis along z and middle at the origin
/// @param body     the spheres that belong to it
/// @param as_read  the same as it lies in the file, for what a message says of specimen.centre
/// @param progress is told where the surfaces lie
/// @returns what to warn of
/// @throws BadInput: a body that is not the nominal one, naming the key and the value that would
///         fit
std::vector<std::string> check_body(const Case& c, const Specimen& placed, const MainBody& body,
                                    const Specimen& as_read, Progress& progress);

}  // namespace breccia
