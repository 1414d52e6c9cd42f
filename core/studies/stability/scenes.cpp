#include "core/studies/stability/scene.hpp"
#include "core/studies/stability/specimens.hpp"

namespace breccia {
namespace {

constexpr auto network = StabilityPart::network, dashpots = StabilityPart::damped, law = StabilityPart::law;

void only_spheres(StabilitySetup& s, std::size_t count) { s.specimen = stack_of(count, s.body); }

}  // namespace

StabilitySetup plain_setup(const Material& material) {
  StabilitySetup s;
  s.specimen = stability_packing(100);
  s.body = stability_body;
  s.material = material;
  s.options.cracks = false;
  s.load.stop_strain = 0.006;
  s.load.stop_after_peak = 0.0;
  s.load.frames = 0;
  return s;
}

const std::vector<StabilityScene>& stability_scenes() {
  using S = StabilitySetup;
  static const std::vector<StabilityScene> scenes{
      {"plain", "nothing: concrete as it is, for comparison", {network, dashpots, law}, [](S&) {}},
      {"modulus-1e6",
       "the lower half 1e-6 times as stiff and strong as the upper",
       {network, dashpots, law},
       [](S& s) { s.change = [](World& w) { soften_lower_half(w, 1e-6); }; }},
      {"masses-1e12",
       "masses over 12 decades (a test would take 1e6 steps and more)",
       {network, dashpots},
       [](S& s) { s.change = [](World& w) { spread_masses(w, 12.0); }; }},
      {"radius-20",
       "40 spheres a 20th as large",
       {network, dashpots, law},
       [](S& s) { add_dust(s.specimen, 20.0, 40); }},
      {"radius-50",
       "40 spheres a 50th as large",
       {network, dashpots, law},
       [](S& s) { add_dust(s.specimen, 50.0, 40); }},
      {"nested",
       "8 spheres with another inside, centres 0.3 radii apart",
       {network, dashpots, law},
       [](S& s) { add_nested(s.specimen, 0.3, 8); }},
      {"nested-deep",
       "the same, centres 1e-7 radii apart",
       {network, dashpots, law},
       [](S& s) { add_nested(s.specimen, 1e-7, 8); }},
      {"far-1e6",
       "coordinates 1e6 m away from the origin",
       {network, dashpots, law},
       [](S& s) {
         s.offset = {1e6, 1e6, 1e6};
       }},
      {"nu-0", "Poisson ratio 0", {network, dashpots, law}, [](S& s) { s.material.poisson_ratio = 0.0; }},
      {"nu-0.49",
       "Poisson ratio 0.49",
       {network, dashpots, law},
       [](S& s) { s.material.poisson_ratio = 0.49; }},
      {"xi-0", "no contact damping", {dashpots, law}, [](S& s) { s.options.contact_damping = 0.0; }},
      {"xi-0.5", "contact damping 0.5", {dashpots, law}, [](S& s) { s.options.contact_damping = 0.5; }},
      {"xi-1",
       "contact damping 1, critical for a pair",
       {dashpots, law},
       [](S& s) { s.options.contact_damping = 1.0; }},
      {"xi-2", "contact damping 2", {dashpots, law}, [](S& s) { s.options.contact_damping = 2.0; }},
      {"delta-0",
       "brittle: no softening",
       {law},
       [](S& s) { s.material.damage_normal = s.material.damage_shear = 0.0; }},
      {"delta-100",
       "softening a hundred times as long as the elastic branch",
       {law},
       [](S& s) { s.material.damage_normal = s.material.damage_shear = 100.0; }},
      {"yrc-1", "no yielding", {law}, [](S& s) { s.material.stiffness_reduction.fill(1.0); }},
      {"yrc-1e4",
       "slopes a ten thousandth of the elastic one beyond each limit",
       {law},
       [](S& s) { s.material.stiffness_reduction.fill(1e4); }},
      {"pressure-650",
       "650 MPa on the lateral surface and the ends",
       {law},
       [](S& s) { s.load.confinement = 650e6; }},
      {"speed-10",
       "platens at 10 m/s, to a strain of 0.1",
       {law},
       [](S& s) { s.load.platen_speed = 10.0, s.load.stop_strain = 0.1; }},
      {"friction-0",
       "no friction at all",
       {law},
       [](S& s) { s.material.friction_static = s.material.friction_dynamic = 0.0; }},
      {"one-sphere", "a specimen of 1 sphere", {law}, [](S& s) { only_spheres(s, 1); }},
      {"two-spheres", "a specimen of 2 spheres", {law}, [](S& s) { only_spheres(s, 2); }},
      {"three-spheres", "a specimen of 3 spheres", {law}, [](S& s) { only_spheres(s, 3); }},
      {"blast", "all bonds broken, thrown outwards at 40 m/s", {law}, [](S& s) { s.blast = 40.0; }},
      {"rest-1e7",
       "pressed a little, then 1e7 steps of rest",
       {law},
       [](S& s) {
         s.specimen = stability_packing(60);
         s.load.stop_strain = 2e-4;
         s.rest_steps = 10'000'000;
       },
       true},
  };
  return scenes;
}

}  // namespace breccia
