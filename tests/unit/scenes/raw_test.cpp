#include "scenes/data/raw.h"

#include "helpers.h"
#include "scenes/errors.h"

namespace volumark {
namespace {

using test::Bytes;
using test::encode;
using test::operator+;
using testing::HasSubstr;

TEST(Raw, LayoutIsHonoured) {
  const std::vector<uint16_t> values = {1, 2, 3, 4, 5, 65535};
  for (const bool big : {false, true}) {
    RawLayout layout{{3, 2, 1}, VoxelType::U16, big, 5, false};
    const Bytes plain = test::bytes_of("12345") + encode(values, big);
    EXPECT_EQ(read_raw(plain, layout, NonFinite::Refuse, "t.raw").at(2, 1, 0), 65535);
    layout.gzip = true;
    const Volume v = read_raw(test::gzipped(plain), layout, NonFinite::Refuse, "t.raw");
    EXPECT_EQ(v.at(1, 0, 0), 2);
    EXPECT_EQ(v.origin, glm::dvec3(-1, -0.5, 0));
  }
}

TEST(Raw, SignedBytes) {
  RawLayout layout{{3, 1, 1}, VoxelType::U8, false, 0, false};
  layout.signed_bytes = true;
  const Volume v = read_raw(encode<int8_t>({-128, 0, 127}), layout, NonFinite::Refuse, "t.raw");
  EXPECT_EQ(v.at(0, 0, 0), -128);
  EXPECT_EQ(v.at(1, 0, 0), 0);
  EXPECT_EQ(v.at(2, 0, 0), 127);
  EXPECT_EQ(v.min_value, -128);
  EXPECT_EQ(v.max_value, 127);
}

TEST(Raw, WrongSizeSaysExpectedAndFound) {
  const RawLayout layout{{3, 2, 1}, VoxelType::U16, false, 0, false};
  EXPECT_THAT(test::message_of<DataError>([&] { read_raw(Bytes(11), layout, NonFinite::Refuse, "t.raw"); }),
              testing::AllOf(HasSubstr("t.raw"), HasSubstr("3 x 2 x 1"), HasSubstr("expected 12 bytes, found 11")));
  const RawLayout skipping{{3, 2, 1}, VoxelType::U16, false, 100, false};
  EXPECT_THAT(test::message_of<DataError>([&] { read_raw(Bytes(12), skipping, NonFinite::Refuse, "t.raw"); }),
              HasSubstr("expected 100 bytes before the samples, found 12"));
}

// Two gzip members in a row are one stream (RFC 1952).
TEST(Raw, SeveralGzipMembers) {
  const RawLayout layout{{4, 1, 1}, VoxelType::U8, false, 0, true};
  const Bytes file = test::gzipped(test::bytes_of("ab")) + test::gzipped(test::bytes_of("cd"));
  EXPECT_EQ(read_raw(file, layout, NonFinite::Refuse, "t.raw").at(3, 0, 0), 'd');
}

}  // namespace
}  // namespace volumark
