#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "core/base/error.hpp"
#include "io/specimens/read_specimen.hpp"
#include "scratch_folder.hpp"

using namespace breccia;

namespace {

const std::string header = "id,x_m,y_m,z_m,r_m\n";

std::string complaint(const std::string& name, const std::string& text) {
  const ScratchFolder folder;
  const auto file = folder.write(name, text);
  try {
    read_specimen(file);
  } catch (const BadInput& error) {
    const std::string line = error.what(), place = file.string();
    REQUIRE(line.find('\n') == std::string::npos);
    REQUIRE(line.starts_with(place + ":"));
    return line.substr(folder.path.string().size() + 1);
  }
  return "accepted";
}

template <class Work>
std::string complaint_of(Work work) {
  try {
    work();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "accepted";
}

void says(const std::string& text, const std::string& part) {
  INFO(text);
  CHECK(text.find(part) != std::string::npos);
}

Specimen two(Vec3 a, Vec3 b) {
  Specimen s;
  s.spheres = {{.id = 7, .centre = a, .radius = 0.01, .line = 2},
               {.id = 9, .centre = b, .radius = 0.01, .line = 3}};
  s.source = "s.csv";
  return s;
}

const std::string mdpa_head = R"(Begin ModelPartData
//  VARIABLE_NAME value
End ModelPartData

Begin Properties 1
PARTICLE_DENSITY 2500.0
End Properties

Begin Nodes // group: cohesive
140 -1 0 0.5
141	1	0	0
150 0 2 0
End Nodes

Begin Elements SphericContinuumParticle3D   //  group
142 1 140
143 1 141
End Elements
)";
const std::string mdpa_radii = "\nBegin NodalData RADIUS  // x\n140 0 1\n141 0 1.5\nEnd NodalData\n";
const std::string mdpa_groups = "\nBegin NodalData COHESIVE_GROUP\n141 0 2\nEnd NodalData\n";
const std::string mdpa_tail = R"(
Begin SubModelPart 1 // part
  Begin SubModelPartData
    TOP  1
  End SubModelPartData
 Begin SubModelPartNodes
       140
 End SubModelPartNodes
End SubModelPart
)";

}  // namespace

TEST_CASE("specimen/csv: ids, centres, radii, groups and lines, with comments, blanks and either line end") {
  const ScratchFolder folder;
  const auto file = folder.write("s.csv",
                                 "\xef\xbb\xbf# made by hand\r\nid,x_m,y_m,z_m,r_m,group\r\n"
                                 "3, 0.1,-2e-3,+4,0.5,0\r\n\r\n# a comment\r\n1,1,2,3,.25,2");
  const Specimen s = read_specimen(file);
  REQUIRE(s.spheres.size() == 2);
  CHECK(s.source == file.string());
  CHECK(s.spheres[0].id == 3);
  CHECK(s.spheres[0].centre == Vec3{0.1, -2e-3, 4});
  CHECK(s.spheres[0].radius == 0.5);
  CHECK(s.spheres[0].group == 0);
  CHECK(s.spheres[0].line == 3);
  CHECK(s.spheres[1].line == 6);
  CHECK(s.spheres[1].group == 2);
  CHECK(read_specimen(folder.write("t.CSV", header + "1,0,0,0,1\n")).spheres[0].group == 1);
}

TEST_CASE("specimen/csv: what is wrong is named with file and line") {
  says(complaint("s.csv", ""), "s.csv: the file is empty");
  says(complaint("s.csv", "\n  \n"), "s.csv: the file is empty");
  says(complaint("s.csv", "# only words\n"), "s.csv: the file is empty");
  says(complaint("s.csv", header), "s.csv: no sphere in the file");
  says(complaint("s.csv", "1,0,0,0,1\n"),
       "s.csv:1: the header is \"1,0,0,0,1\"; it must be \"id,x_m,y_m,z_m,r_m\"");
  says(complaint("s.csv", "id,x,y,z,r\n1,0,0,0,1\n"), "s.csv:1: the header is");
  says(complaint("s.csv", header + "1,0,zero,0,1\n"), "s.csv:2: y_m \"zero\" is not a number");
  says(complaint("s.csv", header + "1,0,0,0,1\n2,0,0,1 mm,1\n"), "s.csv:3: z_m \"1 mm\" is not a number");
  says(complaint("s.csv", header + "1,0,,0,1\n"), "s.csv:2: y_m \"\" is not a number");
  says(complaint("s.csv", header + "1,0,nan,0,1\n"), "s.csv:2: y_m \"nan\" is not a finite number");
  says(complaint("s.csv", header + "1,0,0,0,inf\n"), "s.csv:2: r_m \"inf\" is not a finite number");
  says(complaint("s.csv", header + "1,0,1e999,0,1\n"), "s.csv:2: y_m \"1e999\" is not a finite number");
  says(complaint("s.csv", header + "1,0,0,0\n"), "s.csv:2: 4 columns, the header has 5");
  says(complaint("s.csv", header + "1,0,0,0,1,1\n"), "s.csv:2: 6 columns, the header has 5");
  says(complaint("s.csv", header + "1,0,0,0,1,1,1,1\n"), "s.csv:2: more than 6 columns, the header has 5");
  says(complaint("s.csv", header + "-1,0,0,0,1\n"), "s.csv:2: id \"-1\" is not a whole number");
  says(complaint("s.csv", header + "1.5,0,0,0,1\n"), "s.csv:2: id \"1.5\" is not a whole number");
  says(complaint("s.csv", header + "5,0,0,0,1\n4,1,0,0,1\n5,2,0,0,1\n"), "s.csv:4: id 5 is also in line 2");
  says(complaint("s.csv", header + "1,0,0,0,1\n2,0,0,1,-0.5\n"),
       "s.csv:3: sphere 2 has radius -0.5; it must be above 0");
  says(complaint("s.csv", header + "1,0,0,0,0\n"), "s.csv:2: sphere 1 has radius 0");
  says(complaint("s.csv", "id,x_m,y_m,z_m,r_m,group\n1,0,0,0,1,-1\n"),
       "s.csv:2: group \"-1\" is not a whole number");
  says(complaint("s.msh", "x"),
       "s.msh: specimen type \".msh\" is not in this version; valid: \".csv\", \".mdpa\"");
  says(complaint("s.h5", "x"), "\".h5\" is not in this version");
  says(complaint("s.txt", "x"), "s.txt: unknown specimen type \".txt\"");
  const ScratchFolder folder;
  says(complaint_of([&] { read_specimen(folder.path / "none.csv"); }), "none.csv: no such file");
  std::filesystem::create_directory(folder.path / "folder.csv");
  says(complaint_of([&] { read_specimen(folder.path / "folder.csv"); }), "folder.csv: a folder, not a file");
}

TEST_CASE("specimen/mdpa: nodes that carry spheric elements, with radii and cohesive groups") {
  const ScratchFolder folder;
  const Specimen s = read_specimen(folder.write("s.mdpa", mdpa_head + mdpa_radii + mdpa_groups + mdpa_tail));
  REQUIRE(s.spheres.size() == 2);  // node 150 carries none
  CHECK(s.spheres[0].id == 140);
  CHECK(s.spheres[0].centre == Vec3{-1, 0, 0.5});
  CHECK(s.spheres[0].radius == 1);
  CHECK(s.spheres[0].group == 0);  // the block is there, the node is not in it
  CHECK(s.spheres[0].line == 10);
  CHECK(s.spheres[1].radius == 1.5);
  CHECK(s.spheres[1].group == 2);
  CHECK(read_specimen(folder.write("t.mdpa", mdpa_head + mdpa_radii + mdpa_tail)).spheres[0].group == 1);
}

TEST_CASE("specimen/mdpa: what is wrong is named with file and line") {
  says(complaint("s.mdpa", mdpa_tail), "s.mdpa: no sphere in the file");
  says(complaint("s.mdpa", mdpa_head), "s.mdpa:16: node 140 has no RADIUS in NodalData");
  says(complaint("s.mdpa", "Begin Nodes\n1 0 x 0\nEnd Nodes\n"), "s.mdpa:2: y \"x\" is not a number");
  says(complaint("s.mdpa", "Begin Nodes\n1 0 0\nEnd Nodes\n"),
       "s.mdpa:2: 3 fields; 4 are wanted: node x y z");
  says(complaint("s.mdpa", "Begin Nodes\n1 0 0 0\n1 1 0 0\nEnd Nodes\n"),
       "s.mdpa:3: node 1 is also in line 2");
  says(complaint("s.mdpa", "Begin Nodes\n1 0 0 0\n"), "s.mdpa:1: this block has no End");
  says(complaint("s.mdpa", "1 0 0 0\n"), "s.mdpa:1: \"1 0 0 0\" stands outside any block");
  says(complaint("s.mdpa", mdpa_head + "Begin NodalData RADIUS\n99 0 1\nEnd NodalData\n"),
       "s.mdpa:20: there is no node \"99\"");
  says(complaint("s.mdpa", "Begin Elements SphericParticle3D\n1 1 5\nEnd Elements\n"),
       "s.mdpa:2: there is no node 5");
  says(complaint("s.mdpa", mdpa_head + "Begin NodalData RADIUS\n140 0 -1\n141 0 1\nEnd NodalData\n"),
       "s.mdpa:10: sphere 140 has radius -1");
}

TEST_CASE(
    "specimen/place: the axis turns to z by a cyclic permutation, the middle of the box goes to the origin") {
  Specimen s = two({1, 2, 3}, {1.5, 2.25, 3.125});
  s.spheres[0].radius = 0.25;
  s.spheres[1].radius = 0.5;
  // box: x 0.75 to 2, y 1.75 to 2.75, z 2.625 to 3.625
  const Vec3 middle{1.375, 2.25, 3.125};
  const Vec3 z = s.spheres[0].centre - middle;
  CHECK(place_specimen(s, 'z').spheres[0].centre == z);
  CHECK(place_specimen(s, 'y').spheres[0].centre == Vec3{z.z, z.x, z.y});
  CHECK(place_specimen(s, 'x').spheres[0].centre == Vec3{z.y, z.z, z.x});
  CHECK(place_specimen(s, 'y', Vec3{1, 1, 1}).spheres[0].centre == Vec3{2, 0, 1});
}

TEST_CASE("specimen/check: centres in one place and centres outside are refused by id, line and distance") {
  const Body body{Shape::cylinder, 0.1, 0, 0.2};
  CHECK(complaint_of([&] { check_specimen(two({0, 0, 0}, {0.0519, 0, 0.1019}), body); }) == "accepted");
  says(complaint_of([&] {
         check_specimen(two({0.01, 0, 0}, {0.01, 0, 0}), body);
       }),
       "s.csv:3: sphere 9 has the centre of sphere 7 (line 2)");
  says(complaint_of([&] {
         check_specimen(two({0, 0, 0}, {0.04, 0.04, 0}), body);
       }),
       "s.csv:3: the centre of sphere 9 lies 6.569 mm outside the cylinder D 100 mm x H 200 mm (1 of 2 "
       "spheres beyond the 2 mm allowed)");
  says(complaint_of([&] {
         check_specimen(two({0, 0, -0.11}, {0, 0, 0.105}), body);
       }),
       "s.csv:2: the centre of sphere 7 lies 10 mm outside");
  const Body box{Shape::box, 0.1, 0.05, 0.2};
  says(complaint_of([&] {
         check_specimen(two({0, 0, 0}, {0.04, 0.04, 0}), box);
       }),
       "lies 15 mm outside the box 100 mm x 50 mm x 200 mm");
  says(complaint_of([&] { check_specimen({}, body); }), "no sphere in the specimen");
}

TEST_CASE("specimen/place: in the plane the axis turns to z and the flat coordinate to y = 0") {
  const auto placed = [](const Vec3& a, const Vec3& b, char axis, std::optional<Vec3> centre = {}) {
    const Specimen s = place_specimen(two(a, b), axis, centre, Space::two_d);
    return std::pair{s.spheres[0].centre, s.spheres[1].centre};
  };
  const std::pair wanted{Vec3{-1, 0, -2}, Vec3{1, 0, 2}};
  CHECK(placed({-1, 7, -2}, {1, 7, 2}, 'z') == wanted);  // in the x-z plane
  CHECK(placed({7, -1, -2}, {7, 1, 2}, 'z') == wanted);  // in the y-z plane
  CHECK(placed({-1, -2, 7}, {1, 2, 7}, 'y') == wanted);  // in the x-y plane
  CHECK(placed({-2, -1, 7}, {2, 1, 7}, 'x') == wanted);
  CHECK(placed({-2, 7, -1}, {2, 7, 1}, 'x') == wanted);
  CHECK(placed({-1, 7, -2}, {1, 7 + 3e-9, 2}, 'z') == wanted);  // 1e-9 of the size, 4
  CHECK(placed({-1, 7, -2}, {1, 7, 2}, 'z', Vec3{1, 0, 2}) == std::pair{Vec3{-2, 0, -4}, Vec3{0, 0, 0}});
  CHECK(placed({0, 0, -2}, {0, 0, 2}, 'z') == std::pair{Vec3{0, 0, -2}, Vec3{0, 0, 2}});
  says(complaint_of([&] {
         placed({-1, 7, -2}, {1, 7 + 1e-8, 2}, 'z');
       }),
       "s.csv:3: a 3-D mesh in a 2-D scene");
  says(complaint_of([&] {
         placed({-1, -2, 7}, {1, 2, 7}, 'z');
       }),
       "s.csv:3: a 3-D mesh in a 2-D scene: along x");
  CHECK_NOTHROW(place_specimen({}, 'z', {}, Space::two_d));  // the check for no sphere at all comes later
}

TEST_CASE("specimen/check: centres outside a rectangle or a circle in the plane") {
  const auto complaint = [](const Vec3& b, const Body& body) {
    return complaint_of([&] { check_specimen(two({0, 0, 0}, b), body, Space::two_d); });
  };
  const Body box{Shape::box, 0.1, 0, 0.2}, disc{Shape::disc, 0.1, 0, 0.1};
  CHECK(complaint({0.0519, 0, 0.1019}, box) == "accepted");
  says(complaint({0.055, 0, 0}, box),
       "s.csv:3: the centre of sphere 9 lies 5 mm outside the rectangle 100 mm x 200 mm");
  says(complaint({0, 0, 0.105}, box), "s.csv:3: the centre of sphere 9 lies 5 mm outside");
  CHECK(complaint({0.036, 0, 0.036}, disc) == "accepted");
  says(complaint({0.04, 0, 0.04}, disc),
       "s.csv:3: the centre of sphere 9 lies 6.569 mm outside the disc D 100 mm");
}

TEST_CASE("specimen/write: a specimen reads back bit for bit") {
  const ScratchFolder folder;
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> position(-1, 1);
  Specimen s;
  for (Gid id = 1; id <= 1000; ++id) {
    const Vec3 centre{position(random), position(random) * 1e-9, position(random)};
    s.spheres.push_back({.id = id, .centre = centre, .radius = std::abs(position(random)) + 1e-6});
  }
  for (int group : {1, 4}) {
    s.spheres[17].group = group;
    write_specimen_csv(folder.path / "s.csv", s);
    const Specimen back = read_specimen(folder.path / "s.csv");
    REQUIRE(back.spheres.size() == s.spheres.size());
    for (std::size_t i = 0; i < s.spheres.size(); ++i) {
      REQUIRE(back.spheres[i].id == s.spheres[i].id);
      REQUIRE(back.spheres[i].centre == s.spheres[i].centre);
      REQUIRE(back.spheres[i].radius == s.spheres[i].radius);
      REQUIRE(back.spheres[i].group == s.spheres[i].group);
    }
  }
  CHECK(!std::filesystem::exists(folder.path / "s.csv.part"));
  CHECK_THROWS_AS(write_specimen_csv(folder.path / "s.csv" / "below.csv", s), WriteError);
  CHECK_THROWS_AS(write_specimen_csv(folder.path / "none" / "s.csv", s), WriteError);
}

TEST_CASE("specimen/csv: a long file is read, placed and checked as it was written") {
  const ScratchFolder folder;
  Specimen s;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> position(-1, 1);
  for (Gid id = 1; id <= 50000; ++id)
    s.spheres.push_back(
        {.id = id, .centre = {position(random), position(random), position(random)}, .radius = 0.01});
  write_specimen_csv(folder.path / "s.csv", s);
  const Specimen back = read_specimen(folder.path / "s.csv");
  REQUIRE(back.spheres.size() == s.spheres.size());
  for (std::size_t k = 0; k < s.spheres.size(); ++k) REQUIRE(back.spheres[k].centre == s.spheres[k].centre);
  CHECK_NOTHROW(check_specimen(place_specimen(back, 'y'), {Shape::box, 2.1, 2.1, 2.1}));
}

TEST_CASE("specimen: the meshes behind the source documents lie inside their nominal bodies") {
  struct Mesh {
    const char* file;
    std::size_t spheres;
    char axis;
    Body body;
  };
  const std::filesystem::path folder = std::filesystem::path(BRECCIA_SOURCE_DIR) / "../shared/specimens";
  if (!std::filesystem::exists(folder)) {
    MESSAGE("skipped 'no " << folder.string() << "'");
    return;
  }
  for (const Mesh& mesh : {Mesh{"13k_30_15.csv", 13500, 'y', {Shape::cylinder, 0.150, 0, 0.300}},
                           Mesh{"16k_25x48.csv", 18582, 'y', {Shape::cylinder, 0.0254, 0, 0.04826}},
                           Mesh{"16k_bts_38_22.csv", 15070, 'z', {Shape::disc, 0.0378, 0, 0.0219}}}) {
    INFO(mesh.file);
    const Specimen s = read_specimen(folder / mesh.file);
    CHECK(s.spheres.size() == mesh.spheres);
    CHECK_NOTHROW(check_specimen(place_specimen(s, mesh.axis), mesh.body));
  }
}

TEST_CASE("specimen: the two-sphere benchmarks of Kratos are read") {
  const std::filesystem::path folder = std::filesystem::path(BRECCIA_SOURCE_DIR) / "../shared/reference";
  if (!std::filesystem::exists(folder)) {
    MESSAGE("skipped 'no " << folder.string() << "'");
    return;
  }
  for (const char* name : {"benchmark22DEM.mdpa", "benchmark24DEM.mdpa"}) {
    const Specimen s = read_specimen(folder / name);
    REQUIRE(s.spheres.size() == 2);
    CHECK(s.spheres[0].id == 140);
    CHECK(s.spheres[0].centre == Vec3{-1, 0, 0});
    CHECK(s.spheres[1].radius == 1);
    CHECK(s.spheres[1].group == 1);
  }
}
