#include "scenes/data/nifti.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "helpers.h"
#include "scenes/errors.h"

namespace volumark {
namespace {

using test::Bytes;
using test::encode;
using test::operator+;
using testing::HasSubstr;

// A NIfTI-1 file put together field by field (offsets of nifti1.h), in either byte order.
class File {
 public:
  explicit File(bool big_endian = false) : big_(big_endian), header_(352) {
    put<int32_t>(0, 348);
    dim({3, 3, 2, 2});
    put<int16_t>(70, 4);
    for (const size_t at : {size_t{76}, size_t{80}, size_t{84}, size_t{88}}) put<float>(at, 1);
    put<float>(108, 352);
    std::memcpy(header_.data() + 344, "n+1", 4);
    samples = encode<int16_t>({-5, 0, 1, 2, 300, 4, 5, 6, 7, 8, 9, -32768}, big_);
  }
  template <typename T>
  File& put(size_t offset, T value) {
    const Bytes raw = encode<T>({value}, big_);
    std::copy(raw.begin(), raw.end(), header_.begin() + static_cast<std::ptrdiff_t>(offset));
    return *this;
  }
  File& dim(const std::vector<int16_t>& values) {
    for (size_t i = 0; i < values.size(); ++i) put<int16_t>(40 + 2 * i, values[i]);
    return *this;
  }
  File& srow(const std::vector<float>& values) {
    put<int16_t>(254, 1);
    for (size_t i = 0; i < 12; ++i) put<float>(280 + 4 * i, values[i]);
    return *this;
  }
  File& magic(const char* text) {
    std::memcpy(header_.data() + 344, text, 4);
    return *this;
  }
  Bytes bytes() const { return header_ + samples; }
  Bytes samples;

 private:
  bool big_;
  Bytes header_;
};

Volume read(const Bytes& file, NonFinite non_finite = NonFinite::Refuse) {
  return read_nifti(file, non_finite, "t.nii");
}
std::string error(const Bytes& file) {
  return test::message_of<DataError>([&] { read(file); });
}

TEST(Nifti, BothByteOrdersPlainAndGzip) {
  for (const bool big : {false, true}) {
    const Bytes file = File(big).bytes();
    for (const Bytes& variant : {file, test::gzipped(file)}) {
      const Volume v = read(variant);
      EXPECT_EQ(v.size, glm::ivec3(3, 2, 2));
      EXPECT_EQ(v.type, VoxelType::I16);
      EXPECT_EQ(v.at(1, 1, 0), 300);
      EXPECT_EQ(v.at(2, 1, 1), -32768);
    }
  }
}

TEST(Nifti, AllTypesAndScaling) {
  File f;
  f.put<int16_t>(70, 2).put<float>(112, 0.5f).put<float>(116, -1);
  f.samples = encode<uint8_t>(std::vector<uint8_t>(12, 10));
  EXPECT_EQ(read(f.bytes()).at(0, 0, 0), 4);
  f.put<int16_t>(70, 512).samples = encode<uint16_t>(std::vector<uint16_t>(12, 60000));
  EXPECT_EQ(read(f.bytes()).at(0, 0, 0), 29999);
  f.put<int16_t>(70, 16).put<float>(112, -2).samples = encode<float>({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
  const Volume v = read(f.bytes());
  EXPECT_EQ(v.min_value, -25);  // a negative slope turns the range round
  EXPECT_EQ(v.max_value, -3);
  f.put<float>(112, 0);  // 0 means: not scaled
  EXPECT_EQ(read(f.bytes()).at(1, 0, 0), 2);
}

// Signed bytes are held as unsigned ones, 128 higher, under the file's own slope.
TEST(Nifti, SignedBytes) {
  File f;
  f.put<int16_t>(70, 256).put<float>(112, 0.5f).put<float>(116, 3);
  f.samples = encode<int8_t>({-128, -1, 0, 1, 127, -100, 100, 5, 6, 7, 8, 9});
  const Volume v = read(f.bytes());
  EXPECT_EQ(v.type, VoxelType::U8);
  EXPECT_EQ(v.at(0, 0, 0), -61);
  EXPECT_EQ(v.at(1, 0, 0), 2.5);
  EXPECT_EQ(v.at(2, 0, 0), 3);
  EXPECT_EQ(v.at(1, 1, 0), 66.5);
  EXPECT_EQ(v.min_value, -61);
  EXPECT_EQ(v.max_value, 66.5);
}

TEST(Nifti, SformGivesOrientation) {
  const Volume v = read(File().srow({0, -3, 0, 10, 2, 0, 0, 20, 0, 0, 4, 30}).bytes());
  EXPECT_EQ(v.spacing, glm::dvec3(2, 3, 4));
  EXPECT_EQ(v.axes[0], glm::dvec3(0, 1, 0));
  EXPECT_EQ(v.axes[1], glm::dvec3(-1, 0, 0));
  EXPECT_EQ(v.origin, glm::dvec3(10, 20, 30));
}

// A quaternion of 90 degrees about z takes i to +y and j to -x; qfac -1 turns k round.
TEST(Nifti, QformGivesOrientation) {
  const float half = std::sqrt(0.5f);
  File f;
  f.put<int16_t>(252, 1).put<float>(76, -1).put<float>(80, 2).put<float>(84, 3).put<float>(88, 4);
  f.put<float>(264, half).put<float>(268, 7).put<float>(272, 8).put<float>(276, 9);
  const Volume v = read(f.bytes());
  EXPECT_NEAR(glm::length(v.spacing - glm::dvec3(2, 3, 4)), 0, 1e-6);
  EXPECT_NEAR(glm::length(v.axes[0] - glm::dvec3(0, 1, 0)), 0, 1e-6);
  EXPECT_NEAR(glm::length(v.axes[1] - glm::dvec3(-1, 0, 0)), 0, 1e-6);
  EXPECT_NEAR(glm::length(v.axes[2] - glm::dvec3(0, 0, -1)), 0, 1e-6);
  EXPECT_EQ(v.origin, glm::dvec3(7, 8, 9));
}

TEST(Nifti, SformIsPreferredToQform) {
  const Volume v = read(File().put<int16_t>(252, 1).srow({5, 0, 0, 1, 0, 5, 0, 2, 0, 0, 5, 3}).bytes());
  EXPECT_EQ(v.spacing, glm::dvec3(5));
}

TEST(Nifti, WithoutAFormPixdimIsCentred) {
  const Volume v = read(File().put<float>(80, 2).put<float>(84, 3).put<float>(88, 4).bytes());
  EXPECT_EQ(v.spacing, glm::dvec3(2, 3, 4));
  EXPECT_EQ(v.origin, glm::dvec3(-2, -1.5, -2));
}

TEST(Nifti, SlicesAndTrailingDimensionsOfOne) {
  File f;
  f.dim({2, 4, 3, 0}).put<float>(88, 0);  // a picture: the third size and its spacing are unused
  EXPECT_EQ(read(f.bytes()).size, glm::ivec3(4, 3, 1));
  EXPECT_EQ(read(f.dim({4, 3, 2, 2, 1}).put<float>(88, 1).bytes()).size, glm::ivec3(3, 2, 2));
  EXPECT_THAT(error(f.dim({4, 3, 2, 1, 2}).bytes()), HasSubstr("dimension 4 has 2 entries"));
}

TEST(Nifti, BadHeaders) {
  EXPECT_THAT(error(test::bytes_of("short")), HasSubstr("expected a NIfTI-1 header of 348 bytes, found 5"));
  EXPECT_THAT(error(File().put<int32_t>(0, 540).bytes()), HasSubstr("not a NIfTI-1 file"));
  EXPECT_THAT(error(File().magic("ni1").bytes()), HasSubstr("pair"));
  EXPECT_THAT(error(File().magic("xyz").bytes()), HasSubstr("magic"));
  EXPECT_THAT(error(File().put<int16_t>(70, 64).bytes()), HasSubstr("data type 64"));
  EXPECT_THAT(error(File().dim({3, 0, 2, 2}).bytes()), HasSubstr("at least 1"));
  EXPECT_THAT(error(File().dim({3, 3, -2, 2}).bytes()), HasSubstr("at least 1"));
  EXPECT_THAT(error(File().dim({9}).bytes()), HasSubstr("found 9"));
  EXPECT_THAT(error(File().put<float>(108, 100).bytes()), HasSubstr("vox_offset"));
  EXPECT_THAT(error(File().put<float>(108, std::numeric_limits<float>::quiet_NaN()).bytes()), HasSubstr("vox_offset"));
  EXPECT_THAT(error(File().put<float>(112, std::numeric_limits<float>::infinity()).bytes()), HasSubstr("scl_slope"));
  EXPECT_THAT(error(File().srow({1, 0.5, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}).bytes()), HasSubstr("right angles"));
  EXPECT_THAT(error(File().srow({0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}).bytes()), HasSubstr("axis 0"));
}

TEST(Nifti, TruncatedSaysExpectedAndFound) {
  const Bytes file = File().bytes();
  EXPECT_THAT(error(Bytes(file.begin(), file.end() - 4)), HasSubstr("expected 24 bytes, found 20"));
  EXPECT_THAT(error(file + test::bytes_of("x")), HasSubstr("expected 24 bytes, found 25"));
  const Bytes packed = test::gzipped(file);
  EXPECT_THAT(error(Bytes(packed.begin(), packed.end() - 20)), HasSubstr("truncated"));
  EXPECT_THAT(error(test::gzipped(Bytes(file.begin(), file.end() - 4))), HasSubstr("expected 24 bytes, found 20"));
  EXPECT_THAT(error(test::gzipped(file + Bytes(1 << 20))), HasSubstr("expected 24 bytes, found more"));
}

TEST(Nifti, NonFiniteSamples) {
  File f;
  f.put<int16_t>(70, 16);
  std::vector<float> values(12, 2.0f);
  values[11] = std::numeric_limits<float>::infinity();
  f.samples = encode(values);
  EXPECT_THAT(error(f.bytes()), testing::AllOf(HasSubstr("1 of 12"), HasSubstr("(2, 1, 1)")));
  EXPECT_EQ(read(f.bytes(), NonFinite::Zero).at(2, 1, 1), 0);
}

}  // namespace
}  // namespace volumark
