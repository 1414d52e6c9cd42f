// What a bonded specimen must have before a test is run on it: a way for the load, a lateral
// surface to be pressed, and areas that no flaw has blown up.
#pragma once
#include <string>
#include <vector>

#include "core/bonding/pieces.hpp"
#include "core/elastic/area_factor.hpp"

namespace breccia {

/// @param source  of the specimen, for messages
/// @param warnings  what does not forbid the test is added here
/// @throws BadInput when nothing joins the bodies that the loading holds
void check_connection(const Connection& connection, const Assembly& assembly, const std::string& source,
                      std::vector<std::string>& warnings);

/// @param pressed  the test has a pressure or a wall at the lateral surface
/// @throws BadInput when it is pressed, and is next to nothing or one sphere wide
void check_lateral_surface(const Assembly& assembly, bool pressed, const std::string& source,
                           std::vector<std::string>& warnings);

/// Of alpha = "auto": a flaw, a cut or a thread makes a specimen softer than its bonds explain, and
/// alpha would make up for it with larger areas, which raise every strength.
/// @throws BadInput when alpha is beyond what packings have
void check_area_factor(const AreaFactor& factor, const Assembly& assembly, const Connection& connection,
                       std::vector<std::string>& warnings);

/// "; 3 spheres hang on nothing", "; bonds fall into 2 pieces of 150 and 150"; empty for one piece
/// and no loose sphere.
std::string describe(const Connection& connection);

}  // namespace breccia
