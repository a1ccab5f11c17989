#include "scenes/data/nrrd.h"

#include <glm/geometric.hpp>
#include <limits>

#include "helpers.h"
#include "scenes/errors.h"

namespace volumark {
namespace {

using test::Bytes;
using test::bytes_of;
using test::encode;
using test::operator+;
using testing::AllOf;
using testing::HasSubstr;

const std::vector<int16_t> kValues = {-5, 0, 1, 2, 300, 4, 5, 6, 7, 8, 9, -32768};  // 3 x 2 x 2

std::string header(const std::string& type, const std::string& more) {
  return "NRRD0004\n# a comment\ntype: " + type + "\ndimension: 3\nsizes: 3 2 2\n" + more + "\n";
}

Bytes no_file(const std::string& name) {
  ADD_FAILURE() << "asked for " << name;
  return {};
}

Volume read(const Bytes& file, NonFinite non_finite = NonFinite::Refuse) {
  return read_nrrd(file, no_file, non_finite, "t.nrrd");
}
std::string error(const Bytes& file) {
  return test::message_of<DataError>([&] { read(file); });
}

void expect_values(const Volume& v) {
  ASSERT_EQ(v.size, glm::ivec3(3, 2, 2));
  for (int i = 0; i < 12; ++i) EXPECT_EQ(v.at(i % 3, i / 3 % 2, i / 6), kValues[static_cast<size_t>(i)]);
  EXPECT_EQ(v.min_value, -32768);
  EXPECT_EQ(v.max_value, 300);
}

TEST(Nrrd, EncodingsAndByteOrders) {
  for (const bool big : {false, true}) {
    const std::string endian = std::string("endian: ") + (big ? "big" : "little") + "\n";
    expect_values(read(bytes_of(header("int16", endian + "encoding: raw\n")) + encode(kValues, big)));
    expect_values(read(bytes_of(header("short", endian + "encoding: gzip\n")) + test::gzipped(encode(kValues, big))));
  }
}

TEST(Nrrd, AllTypes) {
  const std::string end = "endian: little\nencoding: raw\n";
  const Volume u8 = read(bytes_of(header("unsigned char", end)) + encode<uint8_t>(std::vector<uint8_t>(12, 200)));
  EXPECT_EQ(u8.type, VoxelType::U8);
  EXPECT_EQ(u8.at(2, 1, 1), 200);
  const Volume u16 = read(bytes_of(header("uint16", end)) + encode<uint16_t>(std::vector<uint16_t>(12, 60000)));
  EXPECT_EQ(u16.at(2, 1, 1), 60000);
  const Volume i8 = read(bytes_of(header("signed char", end)) + encode<int8_t>(std::vector<int8_t>(12, -7)));
  EXPECT_EQ(i8.type, VoxelType::U8);
  EXPECT_EQ(i8.at(2, 1, 1), -7);
  EXPECT_EQ(i8.max_value, -7);
  const Volume f32 = read(bytes_of(header("float", end)) + encode<float>(std::vector<float>(12, 0.25f)));
  EXPECT_EQ(f32.at(2, 1, 1), 0.25);
}

TEST(Nrrd, DetachedDataIsReadBesideTheHeader) {
  std::string asked;
  const auto beside = [&](const std::string& name) {
    asked = name;
    return encode(kValues);
  };
  const Bytes file = bytes_of(header("int16", "endian: little\nencoding: raw\ndata file: values.raw\n"));
  expect_values(read_nrrd(file, beside, NonFinite::Refuse, "t.nhdr"));
  EXPECT_EQ(asked, "values.raw");
}

TEST(Nrrd, ByteSkipAndUserKeysAndWindowsLineEnds) {
  const std::string text =
      "NRRD0005\r\ntype: int16\r\ndimension: 3\r\nsizes: 3 2 2\r\nendian: little\r\nencoding: raw\r\nbyte skip: 3\r\n"
      "mine:=a value: with colons\r\n\r\n";
  expect_values(read(bytes_of(text) + bytes_of("xyz") + encode(kValues)));
}

TEST(Nrrd, SpacingsAndDefaultCentre) {
  const Volume v =
      read(bytes_of(header("int16", "endian: little\nencoding: raw\nspacings: 0.5 2 1.5\n")) + encode(kValues));
  EXPECT_EQ(v.spacing, glm::dvec3(0.5, 2, 1.5));
  EXPECT_EQ(v.origin, glm::dvec3(-0.5, -1, -0.75));
}

// LPS is turned into RAS: x and y change sign, of the directions and of the origin.
TEST(Nrrd, SpaceDirectionsOriginAndSpace) {
  const std::string geometry =
      "space: left-posterior-superior\nspace directions: (0,2,0) (-3,0,0) (0,0,4)\nspace origin: (10,20,30)\n";
  const Volume v = read(bytes_of(header("int16", geometry + "endian: little\nencoding: raw\n")) + encode(kValues));
  EXPECT_EQ(v.spacing, glm::dvec3(2, 3, 4));
  EXPECT_EQ(v.axes[0], glm::dvec3(0, -1, 0));
  EXPECT_EQ(v.axes[1], glm::dvec3(1, 0, 0));
  EXPECT_EQ(v.axes[2], glm::dvec3(0, 0, 1));
  EXPECT_EQ(v.origin, glm::dvec3(-10, -20, 30));
}

TEST(Nrrd, WrongAmountOfDataSaysExpectedAndFound) {
  const std::string head = header("int16", "endian: little\nencoding: raw\n");
  const Bytes values = encode(kValues);
  EXPECT_THAT(error(bytes_of(head) + Bytes(values.begin(), values.end() - 1)),
              AllOf(HasSubstr("t.nrrd"), HasSubstr("expected 24 bytes, found 23")));
  EXPECT_THAT(error(bytes_of(head) + values + bytes_of("zz")), HasSubstr("expected 24 bytes, found 26"));
  EXPECT_THAT(error(bytes_of(head)), HasSubstr("expected 24 bytes, found 0"));
}

TEST(Nrrd, DamagedGzip) {
  const Bytes head = bytes_of(header("int16", "endian: little\nencoding: gzip\n"));
  const Bytes packed = test::gzipped(encode(kValues));
  EXPECT_THAT(error(head + Bytes(packed.begin(), packed.end() - 12)), HasSubstr("truncated"));
  Bytes damaged = packed;
  damaged[12] = ~damaged[12];
  EXPECT_THAT(error(head + damaged), testing::AnyOf(HasSubstr("damaged"), HasSubstr("truncated"), HasSubstr("found")));
  EXPECT_THAT(error(head + bytes_of("this is not gzip")), HasSubstr("damaged"));
  // Ten megabytes of zeros behind 24 bytes that were announced.
  EXPECT_THAT(error(head + test::gzipped(Bytes(10 << 20))), HasSubstr("expected 24 bytes, found more"));
}

TEST(Nrrd, AHugeHeaderClaimDoesNotAllocate) {
  const std::string claim =
      "NRRD0004\ntype: float\ndimension: 3\nsizes: 2000 2000 2000\nendian: little\nencoding: gzip\n\n";
  EXPECT_THAT(error(bytes_of(claim) + test::gzipped(encode(kValues))),
              HasSubstr("expected 32000000000 bytes, found 24"));
  const std::string absurd =
      "NRRD0004\ntype: float\ndimension: 3\nsizes: 1e9 1e9 1e9\nencoding: raw\nendian: little\n\n";
  EXPECT_THAT(error(bytes_of(absurd)), HasSubstr("64 GiB"));
}

TEST(Nrrd, UnsupportedFieldsAreNamed) {
  const auto with = [&](const std::string& more) {
    return error(bytes_of(header("int16", more + "\n")) + encode(kValues));
  };
  EXPECT_THAT(error(bytes_of("PNG\n")), HasSubstr("not a NRRD file"));
  EXPECT_THAT(with("endian: little\nencoding: bzip2"), AllOf(HasSubstr("bzip2"), HasSubstr("raw or gzip")));
  EXPECT_THAT(with("encoding: raw"), HasSubstr("missing field \"endian\""));
  EXPECT_THAT(with("endian: middle\nencoding: raw"), HasSubstr("little or big"));
  EXPECT_THAT(with("endian: little\nencodign: raw"),
              AllOf(HasSubstr("encodign"), HasSubstr("did you mean \"encoding\"")));
  EXPECT_THAT(with("endian: little\nencoding: raw\nblock size: 4"), HasSubstr("\"block size\" is not supported"));
  EXPECT_THAT(with("endian: little\nencoding: raw\nline skip: 2"), HasSubstr("line skip"));
  EXPECT_THAT(with("endian: little\nencoding: raw\nbyte skip: -1"), HasSubstr("byte skip"));
  EXPECT_THAT(with("endian: little\nencoding: raw\nkinds: vector domain domain"), HasSubstr("vector"));
  EXPECT_THAT(with("endian: little\nencoding: raw\nspacings: 1 0 1"), HasSubstr("spacings"));
  EXPECT_THAT(with("endian: little\nencoding: raw\nspacings: 1 nan 1"), HasSubstr("spacings"));
  EXPECT_THAT(with("endian: little\nencoding: raw\nspacings: 1 1"), HasSubstr("expected 3 numbers"));
  EXPECT_THAT(with("endian: little\nencoding: raw\nspace: left-right-up"), HasSubstr("space"));
  EXPECT_THAT(with("endian: little\nencoding: raw\nsizes: 3 2 2"), HasSubstr("twice"));
  EXPECT_THAT(with("endian: little\nencoding: raw\ndata file: LIST"), HasSubstr("single file"));
  EXPECT_THAT(error(bytes_of("NRRD0004\ntype: double\ndimension: 3\nsizes: 1 1 1\nencoding: raw\n\n")),
              HasSubstr("double"));
  EXPECT_THAT(error(bytes_of("NRRD0004\ntype: uint8\ndimension: 4\nsizes: 3 1 1 1\nencoding: raw\n\n")),
              HasSubstr("dimension 4"));
  EXPECT_THAT(error(bytes_of("NRRD0004\nno colon here\n\n")), HasSubstr("without a colon"));
}

TEST(Nrrd, SizesZeroAndFractionsAreRefusedOneIsAllowed) {
  const auto sized = [](const std::string& sizes) {
    return bytes_of("NRRD0004\ntype: uint8\ndimension: 3\nsizes: " + sizes + "\nencoding: raw\n\n");
  };
  EXPECT_THAT(error(sized("0 2 2")), HasSubstr("at least 1"));
  EXPECT_THAT(error(sized("2 -2 2")), HasSubstr("at least 1"));
  EXPECT_THAT(error(sized("2 1.5 2")), HasSubstr("whole numbers"));
  EXPECT_EQ(read(sized("1 1 1") + bytes_of("A")).at(0, 0, 0), 65);
}

TEST(Nrrd, NonFiniteSamplesAreCountedAndPlaced) {
  std::vector<float> values(12, 1.0f);
  values[4] = std::numeric_limits<float>::quiet_NaN();
  values[9] = -std::numeric_limits<float>::infinity();
  const Bytes file = bytes_of(header("float", "endian: little\nencoding: raw\n")) + encode(values);
  EXPECT_THAT(error(file), AllOf(HasSubstr("2 of 12 samples"), HasSubstr("(1, 1, 0)"), HasSubstr("non_finite")));
  const Volume zeroed = read(file, NonFinite::Zero);
  EXPECT_EQ(zeroed.at(1, 1, 0), 0);
  EXPECT_EQ(zeroed.min_value, 0);
  EXPECT_EQ(zeroed.max_value, 1);
}

}  // namespace
}  // namespace volumark
