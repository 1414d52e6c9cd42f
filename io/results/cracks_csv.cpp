#include "io/results/cracks_csv.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <iterator>

#include "io/files/write_error.hpp"

namespace breccia {

CrackFile::CrackFile(const std::filesystem::path& file) : path_(file), out_(file, std::ios::trunc) {
  if (!out_) fail_to_write(file, errno);
  out_ << "time_s,axial_strain,gid_lo,gid_hi,x_m,y_m,z_m,nx,ny,nz,mode,normal_force_N,shear_force_N,area_m2,"
          "energy_J\n";
  if (!out_.flush()) fail_to_write(file, errno);
}

void CrackFile::add(std::span<const Crack> cracks) {
  std::string text;
  for (const Crack& c : cracks)
    fmt::format_to(
        std::back_inserter(text),
        "{:.9g},{:.6g},{},{},{:.7g},{:.7g},{:.7g},{:.5f},{:.5f},{:.5f},{},{:.6g},{:.6g},{:.6g},{:.6g}\n",
        c.time, c.axial_strain, c.gid_lo, c.gid_hi, c.position.x, c.position.y, c.position.z, c.normal.x,
        c.normal.y, c.normal.z, static_cast<int>(c.mode), c.normal_force, c.shear_force, c.area, c.energy);
  errno = 0;
  if (!(out_ << text).flush()) fail_to_write(path_, errno);
}

}  // namespace breccia
