// OBJ and PLY: what they say, in all the ways in which they may say it, and what is refused.
#include <glm/geometric.hpp>

#include "helpers.h"
#include "scenes/data/read_mesh.h"
#include "scenes/errors.h"

namespace volumark {
namespace {

using test::Bytes;
using test::bytes_of;
using test::encode;
using test::operator+;
using testing::AllOf;
using testing::HasSubstr;
using Triangle = std::array<uint32_t, 3>;

std::string refusal(const Bytes& file, const std::string& name) {
  return test::message_of<DataError>([&] { read_mesh(file, name); });
}
std::string obj_refusal(const std::string& text) { return refusal(bytes_of(text), "m.obj"); }
std::string ply_refusal(const std::string& text) { return refusal(bytes_of(text), "m.ply"); }

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(Obj, PolygonsBecomeFans) {
  const Mesh mesh = read_mesh(bytes_of("# a square\no name\n" + kSquare + "g x\nusemtl y\nf 1 2 3 4\n"), "m.obj");
  EXPECT_EQ(mesh.positions.size(), 4u);
  EXPECT_THAT(mesh.triangles, testing::ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
  EXPECT_TRUE(mesh.normals.empty());
  EXPECT_TRUE(mesh.texture.empty());
}

TEST(Obj, AllFormsOfIndices) {
  const std::string tail = "vt 0.25 0.5\nvt 1 0\nvn 0 0 2\n";
  const Mesh all = read_mesh(bytes_of(kSquare + tail + "f 1/1/1 2/2/1 3/1/1\nf -4/-2/-1 -2/-1/-1 -1/-1/-1\n"), "m.obj");
  EXPECT_THAT(all.triangles, testing::ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
  ASSERT_EQ(all.normals.size(), 4u);
  EXPECT_EQ(all.normals[3], glm::dvec3(0, 0, 2));
  EXPECT_EQ(all.texture[1][0], glm::dvec2(0.25, 0.5));
  EXPECT_EQ(all.texture[1][2], glm::dvec2(1, 0));
  const Mesh normals = read_mesh(bytes_of(kSquare + tail + "f 1//1 2//1 3//1\n"), "m.obj");
  EXPECT_EQ(normals.normals.size(), 3u);
  EXPECT_TRUE(normals.texture.empty());
  const Mesh texture = read_mesh(bytes_of(kSquare + tail + "f 1/1 2/2 3/1\n"), "m.obj");
  EXPECT_TRUE(texture.normals.empty());
  EXPECT_EQ(texture.texture[0][1], glm::dvec2(1, 0));
  // One corner without: the mesh has none.
  const Mesh mixed = read_mesh(bytes_of(kSquare + tail + "f 1/1/1 2/2/1 3/1/1\nf 1 3/1 4/1\n"), "m.obj");
  EXPECT_TRUE(mixed.normals.empty());
  EXPECT_TRUE(mixed.texture.empty());
}

TEST(Obj, APositionWithTwoNormalsBecomesTwo) {
  const Mesh mesh = read_mesh(bytes_of(kSquare + "vn 0 0 1\nvn 1 0 0\nf 1//1 2//1 3//1\nf 1//2 3//1 4//2\n"), "m.obj");
  EXPECT_EQ(mesh.positions.size(), 5u);
  EXPECT_EQ(mesh.positions[mesh.triangles[1][0]], glm::dvec3(0, 0, 0));
  EXPECT_EQ(mesh.normals[mesh.triangles[0][0]], glm::dvec3(0, 0, 1));
  EXPECT_EQ(mesh.normals[mesh.triangles[1][0]], glm::dvec3(1, 0, 0));
  EXPECT_EQ(mesh.triangles[0][2], mesh.triangles[1][1]);
}

TEST(Obj, NumbersLinesAndSpaces) {
  const Mesh mesh = read_mesh(
      bytes_of("v +1.5e-1 -.5 3. 1.0\r\nv\t1 0 0 0.5 0.5 0.5\r\n  v 0 1 0 # third\nvt 0.5\nf \\\n 1/1 2/1 \\\r\n 3/1"),
      "m.obj");
  EXPECT_EQ(mesh.positions[0], glm::dvec3(0.15, -0.5, 3));
  EXPECT_THAT(mesh.triangles, testing::ElementsAre(Triangle{0, 1, 2}));
  EXPECT_EQ(mesh.texture[0][2], glm::dvec2(0.5, 0));
}

TEST(Obj, ErrorsNameTheLine) {
  EXPECT_THAT(obj_refusal(""), HasSubstr("m.obj: the mesh has no triangle"));
  EXPECT_THAT(obj_refusal(kSquare), HasSubstr("no triangle"));
  EXPECT_THAT(obj_refusal("v 0 0\n"), AllOf(HasSubstr("m.obj:1:"), HasSubstr("end of the line")));
  EXPECT_THAT(obj_refusal("v 0 0 0\nv 0 nan 0\n"), AllOf(HasSubstr("m.obj:2:"), HasSubstr("\"nan\"")));
  EXPECT_THAT(obj_refusal("v 0 inf 0\n"), HasSubstr("\"inf\""));
  EXPECT_THAT(obj_refusal("v 0 1,5 0\n"), HasSubstr("\"1,5\""));
  EXPECT_THAT(obj_refusal("v 0 1e999 0\n"), HasSubstr("1e999"));
  EXPECT_THAT(obj_refusal("v 0 1e13 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n"),
              HasSubstr("position 0 is (0, 10000000000000, 0)"));
  EXPECT_THAT(obj_refusal(kSquare + "f 1 2 5\n"),
              AllOf(HasSubstr("m.obj:5:"), HasSubstr("index 5"), HasSubstr("are 4")));
  EXPECT_THAT(obj_refusal(kSquare + "f 1 2 0\n"), HasSubstr("index 0"));
  EXPECT_THAT(obj_refusal(kSquare + "f 1 2 -5\n"), HasSubstr("index -5"));
  EXPECT_THAT(obj_refusal(kSquare + "f 1 2 99999999999999999999\n"), HasSubstr("index of a position"));
  EXPECT_THAT(obj_refusal(kSquare + "f 1/1 2/1 3/1\n"), HasSubstr("index 1 of a texture coordinate: there are 0"));
  EXPECT_THAT(obj_refusal(kSquare + "f 1 2\n"), HasSubstr("a face with 2 corners"));
  EXPECT_THAT(obj_refusal(kSquare + "f 1/1/1/1 2 3\n"), HasSubstr("a corner such as"));
  EXPECT_THAT(obj_refusal(kSquare + "f 1 2 \\"), HasSubstr("after a backslash"));
}

std::string ply_header(const std::string& format,
                       const std::string& vertex = "property float x\nproperty float y\nproperty float z\n") {
  return "ply\nformat " + format + " 1.0\ncomment by hand\nelement vertex 4\n" + vertex +
         "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
}

TEST(Ply, Ascii) {
  const Mesh mesh =
      read_mesh(bytes_of(ply_header("ascii") + "0 0 0\n1 0 0\n\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n"), "m.ply");
  EXPECT_EQ(mesh.positions.size(), 4u);
  EXPECT_EQ(mesh.positions[2], glm::dvec3(1, 1, 0));
  EXPECT_THAT(mesh.triangles, testing::ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
}

// Every type, in lists and out of them, an element and properties that are passed over, polygons, in both byte orders.
TEST(Ply, BinaryOfBothByteOrdersAndAllTypes) {
  for (const bool big : {false, true}) {
    const auto one = [big](auto value) { return encode(std::vector{value}, big); };
    Bytes file =
        bytes_of(std::string("ply\nformat binary_") + (big ? "big" : "little") +
                 "_endian 1.0\nelement extra 1\nproperty list ushort double junk\nproperty uint8 id\n"
                 "element vertex 4\nproperty short x\nproperty int8 weight\nproperty double y\nproperty float32 z\n"
                 "property float nx\nproperty float ny\nproperty float nz\nproperty float s\nproperty float t\n"
                 "property list int uint8 tags\n"
                 "element face 1\nproperty uint flags\nproperty list uint16 int16 vertex_index\nend_header\n");
    file = file + one(uint16_t{2}) + one(1.5) + one(2.5) + one(uint8_t{7});
    for (int i = 0; i < 4; ++i) {
      file =
          file + one(static_cast<int16_t>(-300 * i)) + one(int8_t{-1}) + one(0.25 * i) + one(static_cast<float>(i * i));
      file = file + one(0.0f) + one(1.0f) + one(2.0f) + one(0.125f * static_cast<float>(i)) + one(0.5f);
      file = file + one(int32_t{2}) + one(uint8_t{1}) + one(uint8_t{2});
    }
    file = file + one(uint32_t{9}) + one(uint16_t{4});
    for (const int16_t corner : {0, 1, 2, 3}) file = file + one(corner);
    const Mesh mesh = read_mesh(file, "m.ply");
    ASSERT_EQ(mesh.positions.size(), 4u);
    EXPECT_EQ(mesh.positions[3], glm::dvec3(-900, 0.75, 9));
    EXPECT_EQ(mesh.normals[3], glm::dvec3(0, 1, 2));
    EXPECT_THAT(mesh.triangles, testing::ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
    EXPECT_EQ(mesh.texture[1][2], glm::dvec2(0.375, 0.5));
    EXPECT_THAT(refusal(Bytes(file.begin(), file.end() - 1), "m.ply"),
                AllOf(HasSubstr("face 0"), HasSubstr("too early")));
  }
}

TEST(Ply, TextureCoordinatesOfCorners) {
  const std::string file =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
      "property list uchar int vertex_indices\nproperty list uchar float texcoord\nend_header\n0 0 0\n1 0 0\n0 1 0\n";
  const Mesh mesh = read_mesh(bytes_of(file + "3 0 1 2 6 0 0 .5 0 0 .25\n"), "m.ply");
  EXPECT_EQ(mesh.texture[0][2], glm::dvec2(0, 0.25));
  EXPECT_THAT(ply_refusal(file + "3 0 1 2 4 0 0 1 0\n"), HasSubstr("4 texture coordinates for 3 corners"));
}

TEST(Ply, ErrorsNameTheLine) {
  const std::string header = ply_header("ascii"), good = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  EXPECT_THAT(ply_refusal(""), HasSubstr("ends too early"));
  EXPECT_THAT(ply_refusal("plx\n"), HasSubstr("no PLY file"));
  EXPECT_THAT(ply_refusal("ply\nformat ascii 2.0\n"), AllOf(HasSubstr("m.ply:2:"), HasSubstr("\"2.0\"")));
  EXPECT_THAT(ply_refusal("ply\nformat binary 1.0\n"), HasSubstr("unknown format \"binary\""));
  EXPECT_THAT(ply_refusal("ply\nformat ascii 1.0\nelement vertex -1\n"), HasSubstr("\"-1\""));
  EXPECT_THAT(ply_refusal("ply\nformat ascii 1.0\nelement vertex 1\nproperty half x\n"),
              HasSubstr("unknown type \"half\""));
  EXPECT_THAT(ply_refusal("ply\nformat ascii 1.0\nelement vertex 1\nproperty list float int x\n"),
              HasSubstr("whole number"));
  EXPECT_THAT(ply_refusal("ply\nelement vertex 0\nend_header\n"), HasSubstr("states no format"));
  EXPECT_THAT(ply_refusal("ply\nformat ascii 1.0\nfoo\n"), HasSubstr("unknown word \"foo\""));
  EXPECT_THAT(ply_refusal("ply\nformat ascii 1.0\nend_header\n"), HasSubstr("expected the elements vertex and face"));
  EXPECT_THAT(ply_refusal(ply_header("ascii", "property float x\nproperty float y\n") + good),
              HasSubstr("no x, y and z"));
  EXPECT_THAT(ply_refusal(header + "0 0 0\n1 0\n"), AllOf(HasSubstr("m.ply:12:"), HasSubstr("end of the line")));
  EXPECT_THAT(ply_refusal(header + "0 0 0 0\n1 0 0\n"), HasSubstr("goes on"));
  EXPECT_THAT(ply_refusal(header + "0 nan 0\n"), AllOf(HasSubstr("m.ply:11:"), HasSubstr("(0, nan, 0)")));
  EXPECT_THAT(ply_refusal(header + good + "3 0 1 4\n"),
              AllOf(HasSubstr("m.ply:15:"), HasSubstr("index 4"), HasSubstr("are 4")));
  EXPECT_THAT(ply_refusal(header + good + "3 0 1 -1\n"), HasSubstr("index -1"));
  EXPECT_THAT(ply_refusal(header + good + "2 0 1\n"), HasSubstr("a face with 2 corners"));
  EXPECT_THAT(ply_refusal(header + good + "3 0 1 1.5\n"), HasSubstr("\"1.5\""));
  EXPECT_THAT(ply_refusal(header + good + "300 0 1 2\n"), HasSubstr("\"300\""));
  EXPECT_THAT(ply_refusal(header + good + "3 0 1 2\n"), HasSubstr("ends too early"));
}

// A header may claim billions: memory grows with what is there.
TEST(Ply, HugeClaimsAreRefusedAtTheEndOfTheFile) {
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\n"
      "property float z\nproperty list uint double w\nelement face 1\nproperty list int int "
      "vertex_indices\nend_header\n";
  const Bytes row = encode<float>({1, 2, 3}) + encode<uint32_t>({0xffffffff});
  EXPECT_THAT(refusal(bytes_of(header) + row, "m.ply"), AllOf(HasSubstr("vertex 0"), HasSubstr("too early")));
}

TEST(MeshFiles, Gzip) {
  const Bytes plain = bytes_of(kSquare + "f 1 2 3\n"), packed = test::gzipped(plain);
  EXPECT_EQ(read_mesh(packed, "m.obj.gz").triangles.size(), 1u);
  EXPECT_THAT(refusal(Bytes(packed.begin(), packed.end() - 12), "m.obj.gz"),
              HasSubstr("m.obj.gz: the gzip stream is truncated"));
  EXPECT_THAT(refusal(plain, "m.obj.gz"), HasSubstr("gzip stream is damaged"));
  EXPECT_THAT(refusal(plain, "m.stl"), HasSubstr("expected .obj, .obj.gz, .ply or .ply.gz"));
}

}  // namespace
}  // namespace volumark
