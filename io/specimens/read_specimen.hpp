// Specimens from files, put in place and checked.
#pragma once
#include <filesystem>
#include <optional>

#include "core/base/scene_options.hpp"
#include "core/geometry/specimen.hpp"

namespace breccia {

/// @throws BadInput unless the file's ending is one that `read_specimen` knows
void check_specimen_type(const std::filesystem::path& file);

/// Reads the spheres of a file, as they lie in it. .csv: header `id,x_m,y_m,z_m,r_m`, then
/// optionally `group`; lines that begin with # are comments. .mdpa (Kratos): the nodes of spheric
/// particles; groups from NodalData COHESIVE_GROUP.
/// @throws BadInput: one line with file and line: absent, empty, not a number, columns, double id,
///         radius not above zero
Specimen read_specimen(const std::filesystem::path& file);

/// Turns the axis to z by a cyclic permutation of the coordinates and moves the middle of the box
/// around the spheres, or `centre` (m, in the coordinates of the file), to the origin.
///
/// In the plane the axis becomes z, the coordinate that is the same for all discs becomes y = 0,
/// and the third one x.
/// @throws BadInput in the plane: centres do not lie in one plane along the axis, to 1e-9 of the
///         specimen's size
/// @param of_body  per sphere, 0 where it does not belong to the body whose box is meant; empty:
///         all do
Specimen place_specimen(Specimen, char axis, std::optional<Vec3> centre = {}, Space space = Space::three_d,
                        const std::vector<char>& of_body = {});

/// The middle of the box around the spheres that belong to the body, as they lie in the file, m.
Vec3 middle_of(const Specimen&, const std::vector<char>& of_body);

/// A way in a specimen that is in place, as it runs in the file that it was read from.
Vec3 way_in_file(const Specimen& as_read, const Vec3& way, char axis, Space space);

/// Checks the radii, before anything is made of them.
/// @throws BadInput: a sphere so small or large that no step is right for it and the others
void check_sizes(const Specimen&);

/// Stands a disc that is in place (axis along z) on its edge: its axis becomes y, the diameter to
/// press z. A rotation, never a mirror.
/// @param axis       of the disc in the file, as given to place_specimen
/// @param load_axis  of the file; by default the y of a disc along z, else the z
Specimen stand_disc(Specimen, char axis, std::optional<char> load_axis);

/// Checks a specimen that is in place.
/// @throws BadInput: no sphere, two spheres with one centre, a centre outside the body by more than
/// 2 % of the diameter
/// @param of_body  per sphere, 0 where it hangs on nothing, for what the message advises; empty:
///         all hang
void check_specimen(const Specimen&, const Body&, Space space = Space::three_d,
                    const std::vector<char>& of_body = {});

/// Writes spheres as .csv such that they read back bit for bit; aside first, then renamed.
/// @throws WriteError
void write_specimen_csv(const std::filesystem::path& file, const Specimen&);

}  // namespace breccia
