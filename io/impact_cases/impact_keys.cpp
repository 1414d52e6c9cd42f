#include "io/impact_cases/impact_keys.hpp"

#include <array>

namespace breccia {
namespace {

constexpr Dimension spin{0, 0, -1}, acceleration{0, 1, -2}, stiffness{1, 0, -2};
constexpr Range more_than(double low) { return {.low = low, .low_open = true}; }
constexpr Range at_least(double low) { return {.low = low}; }

Vec3 vector_of(const Reading& r) { return {r.numbers[0], r.numbers[1], r.numbers[2]}; }

// clang-format off: a declaration reads best in few lines
using R = Reading;
using M = ImpactMaterial;
constexpr std::array materials{
    Field<M>{{.name = "materials.density",
              .dimension = dimension::density,
              .range = more_than(0),
              .meaning = "a wall needs none"},
             [](M& m, const R& r) { m.density = r.number; }},
    Field<M>{{.name = "materials.young_modulus",
              .dimension = dimension::stress,
              .range = more_than(0),
              .meaning = "a rigid wall: a large one, \"1e9 GPa\""},
             [](M& m, const R& r) { m.young_modulus = r.number; },
             true},
    Field<M>{
        {.name = "materials.poisson_ratio", .range = {0, 0.5, false, true}, .meaning = "of the material"},
        [](M& m, const R& r) { m.poisson_ratio = r.number; },
        true},
    Field<M>{{.name = "materials.friction",
              .default_text = "0",
              .range = at_least(0),
              .meaning = "Coulomb; of two materials the mean"},
             [](M& m, const R& r) { m.friction = r.number; }},
    Field<M>{{.name = "materials.restitution",
              .default_text = "1",
              .range = {0.01, 1, false, false},
              .meaning = "rebound over approach speed; of two materials the mean"},
             [](M& m, const R& r) { m.restitution = r.number; }},
    Field<M>{{.name = "materials.rolling_friction",
              .default_text = "0",
              .range = at_least(0),
              .meaning = "resisting torque over R* F_n; of two materials the mean"},
             [](M& m, const R& r) { m.rolling_friction = r.number; }},
};

using P = ParticleEntry;
constexpr std::array particles{
    Field<P>{{.name = "particle.position",
              .kind = Kind::quantities,
              .dimension = dimension::length,
              .count = 3,
              .meaning = "of the centre"},
             [](P& p, const R& r) { p.particle.position = vector_of(r); },
             true},
    Field<P>{{.name = "particle.radius",
              .dimension = dimension::length,
              .range = more_than(0),
              .meaning = "of the sphere"},
             [](P& p, const R& r) { p.particle.radius = r.number; },
             true},
    Field<P>{{.name = "particle.velocity",
              .kind = Kind::quantities,
              .dimension = dimension::speed,
              .default_text = "0 0 0",
              .count = 3,
              .meaning = "at the start"},
             [](P& p, const R& r) { p.particle.velocity = vector_of(r); }},
    Field<P>{{.name = "particle.spin",
              .kind = Kind::quantities,
              .dimension = spin,
              .default_text = "0 0 0",
              .count = 3,
              .meaning = "angular velocity at the start, \"2 rad/s\""},
             [](P& p, const R& r) { p.particle.spin = vector_of(r); }},
    Field<P>{{.name = "particle.material", .kind = Kind::text, .meaning = "NAME of [materials.NAME]"},
             [](P& p, const R& r) { p.material = r.word; },
             true},
};

using W = WallEntry;
constexpr std::array walls{
    Field<W>{{.name = "wall.kind",
              .kind = Kind::word,
              .words = "plane cylinder triangle",
              .meaning = "of a cylinder the inside"},
             [](W& w, const R& r) { w.kind = r.word; },
             true},
    Field<W>{{.name = "wall.point",
              .kind = Kind::quantities,
              .dimension = dimension::length,
              .count = 3,
              .meaning = "on the plane, or on the cylinder's axis"},
             [](W& w, const R& r) { w.wall.shape.point = vector_of(r); },
             true,
             "plane cylinder"},
    Field<W>{{.name = "wall.normal",
              .kind = Kind::quantities,
              .count = 3,
              .meaning = "of the plane, towards the particles; any length"},
             [](W& w, const R& r) { w.wall.shape.direction = vector_of(r); },
             true,
             "plane"},
    Field<W>{
        {.name = "wall.axis", .kind = Kind::quantities, .count = 3, .meaning = "of the cylinder; any length"},
        [](W& w, const R& r) { w.wall.shape.direction = vector_of(r); },
        true,
        "cylinder"},
    Field<W>{{.name = "wall.radius",
              .dimension = dimension::length,
              .range = more_than(0),
              .meaning = "of the cylinder"},
             [](W& w, const R& r) { w.wall.shape.radius = r.number; },
             true,
             "cylinder"},
    Field<W>{{.name = "wall.first",
              .kind = Kind::quantities,
              .dimension = dimension::length,
              .count = 3,
              .meaning = "corner of the triangle; it has two sides"},
             [](W& w, const R& r) { w.wall.shape.point = vector_of(r); },
             true,
             "triangle"},
    Field<W>{{.name = "wall.second",
              .kind = Kind::quantities,
              .dimension = dimension::length,
              .count = 3,
              .meaning = "corner"},
             [](W& w, const R& r) { w.wall.shape.second = vector_of(r); },
             true,
             "triangle"},
    Field<W>{{.name = "wall.third",
              .kind = Kind::quantities,
              .dimension = dimension::length,
              .count = 3,
              .meaning = "corner"},
             [](W& w, const R& r) { w.wall.shape.third = vector_of(r); },
             true,
             "triangle"},
    Field<W>{{.name = "wall.material", .kind = Kind::text, .meaning = "NAME of [materials.NAME]"},
             [](W& w, const R& r) { w.material = r.word; },
             true},
};

using S = ImpactScene;
constexpr std::array scene{
    Field<S>{{.name = "contact.law",
              .kind = Kind::word,
              .default_text = "hertz-mindlin",
              .words = "hertz-mindlin linear",
              .meaning = "linear: k_n = E A/(r_i + r_j)"},
             [](S& s, const R& r) {
               s.law = r.word == "linear" ? ContactLaw::linear : ContactLaw::hertz_mindlin;
             }},
    Field<S>{
        {.name = "contact.form",
         .kind = Kind::word,
         .default_text = "dissipative",
         .words = "dissipative classic",
         .meaning = "of hertz-mindlin; dissipative: never pulls and never gains energy; classic: as older "
                    "codes have it"},
        [](S& s, const R& r) { s.form = r.word == "classic" ? HertzForm::classic : HertzForm::dissipative; }},
    Field<S>{{.name = "contact.rolling",
              .kind = Kind::word,
              .default_text = "elastic-plastic",
              .words = "elastic-plastic constant",
              .meaning = "how rolling friction resists"},
             [](S& s, const R& r) {
               s.rolling = r.word == "constant" ? RollingModel::constant : RollingModel::elastic_plastic;
             }},
    Field<S>{{.name = "contact.stiffness",
              .dimension = stiffness,
              .range = more_than(0),
              .meaning = "k_n of the linear law, instead of the one from E"},
             [](S& s, const R& r) { s.stiffness = r.number; }},
    Field<S>{{.name = "scene.gravity",
              .kind = Kind::quantities,
              .dimension = acceleration,
              .default_text = "0 0 0",
              .count = 3,
              .meaning = "\"-9.81 m/s^2\" along z"},
             [](S& s, const R& r) { s.gravity = vector_of(r); }},
    Field<S>{{.name = "time.duration",
              .dimension = dimension::time,
              .range = more_than(0),
              .meaning = "of the run"},
             [](S& s, const R& r) { s.duration = r.number; },
             true},
    Field<S>{
        {.name = "time.safety",
         .default_text = "0.002",
         .range = {0, 0.5, true, false},
         .meaning = "of the step that is critical for the fastest approach; 0.002: 1500 steps a contact"},
        [](S& s, const R& r) { s.safety = r.number; }},
    Field<S>{{.name = "output.rows",
              .kind = Kind::whole_number,
              .default_text = "2000",
              .range = {1, 1e6, false, false},
              .meaning = "of the curve, about"},
             [](S& s, const R& r) { s.rows = static_cast<int>(r.whole); }},
};
// clang-format on

}  // namespace

std::span<const Field<ImpactMaterial>> material_fields() { return materials; }
std::span<const Field<ParticleEntry>> particle_fields() { return particles; }
std::span<const Field<WallEntry>> wall_fields() { return walls; }
std::span<const Field<ImpactScene>> scene_fields() { return scene; }

}  // namespace breccia
