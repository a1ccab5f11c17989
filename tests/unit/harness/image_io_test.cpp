// Images as files: what is written reads back; what is damaged is refused.
#include "harness/image_io.h"

#include <gtest/gtest.h>

#include <cmath>

#include "harness/pfm.h"
#include "tests/unit/harness/test_folder.h"

namespace volumark {
namespace {

Image gradient(int width, int height) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      float* p = image.pixel(x, y);
      p[3] = static_cast<float>(y + 1) / static_cast<float>(height);
      p[0] = p[3] * static_cast<float>(x) / static_cast<float>(width);
      p[1] = p[3] * 0.25F;
      p[2] = 0;
    }
  return image;
}

TEST(Pfm, RoundTripKeepsEveryBitAndRowZeroOnTop) {
  const TestFolder folder;
  Image image = gradient(5, 3);
  for (size_t i = 3; i < image.rgba.size(); i += 4) image.rgba[i] = 1;
  image.pixel(2, 0)[0] = 1e-38F;
  image.pixel(2, 1)[1] = 12345.678F;
  write_image(folder.path() / "a.pfm", image, glm::dvec3(0));
  const Image back = read_image(folder.path() / "a.pfm");
  EXPECT_EQ(back.width, 5);
  EXPECT_EQ(back.height, 3);
  EXPECT_EQ(back.rgba, image.rgba);
}

TEST(Pfm, BigEndianIsRead) {
  std::string text = "PF\n1 1\n1.0\n";
  for (int c = 0; c < 3; ++c) text += std::string("\x3f\x80\x00\x00", 4);
  EXPECT_EQ(decode_pfm(text, "a").rgba, (std::vector<float>{1, 1, 1, 1}));
}

TEST(Pfm, DamageIsRefused) {
  const std::string good = encode_pfm(gradient(4, 4));
  EXPECT_NO_THROW(decode_pfm(good, "a"));
  for (size_t length = 0; length < good.size(); ++length)
    EXPECT_THROW(decode_pfm(good.substr(0, length), "a"), ImageError) << length;
  EXPECT_THROW(decode_pfm(good + "x", "a"), ImageError);
  for (const char* header : {"Pf\n1 1\n-1\n", "PF\n0 1\n-1\n", "PF\n-1 1\n-1\n", "PF\n1 1\n0\n", "PF\n1 1\nnan\n",
                             "PF\n99999999999 1\n-1\n", "PF\n1000000 1000000\n-1\n", "PF"})
    EXPECT_THROW(decode_pfm(std::string(header) + std::string(12, 'a'), "a"), ImageError) << header;
}

TEST(ImageIo, TheSuffixDecidesAndUnknownOnesAreNamed) {
  const TestFolder folder;
  EXPECT_THROW(write_image(folder.path() / "a.jpg", gradient(2, 2), glm::dvec3(0)), ImageError);
  EXPECT_THROW(read_image(folder.path() / "missing.pfm"), ImageError);
  EXPECT_THROW(write_image("/nonexistent/a.pfm", gradient(2, 2), glm::dvec3(0)), ImageError);
  EXPECT_THROW(write_image(folder.path() / "a.pfm", Image(), glm::dvec3(0)), ImageError);
}

class WithModule : public testing::Test {
 protected:
  void SetUp() override {
    std::string why;
    if (!has_image_module(&why)) GTEST_SKIP() << why;
  }
};

TEST_F(WithModule, ExrKeepsFloatsAndAlpha) {
  const TestFolder folder;
  Image image = gradient(7, 5);
  image.pixel(1, 1)[0] = 1234.5F;
  write_image(folder.path() / "a.exr", image, glm::dvec3(1));
  EXPECT_EQ(read_image(folder.path() / "a.exr").rgba, image.rgba);
}

TEST_F(WithModule, PngIsSrgbOverTheBackground) {
  const TestFolder folder;
  Image image(2, 1);
  image.pixel(0, 0)[0] = 0.5F;  // red, half transparent
  image.pixel(0, 0)[3] = 0.5F;
  write_image(folder.path() / "a.png", image, glm::dvec3(0, 1, 0));
  const Image back = read_image(folder.path() / "a.png");
  EXPECT_NEAR(back.pixel(0, 0)[0], 0.5, 0.004);
  EXPECT_NEAR(back.pixel(0, 0)[1], 0.5, 0.004);
  EXPECT_NEAR(back.pixel(0, 0)[2], 0, 1e-6);
  EXPECT_NEAR(back.pixel(1, 0)[1], 1, 1e-6);
  EXPECT_EQ(back.pixel(0, 0)[3], 1);
}

TEST_F(WithModule, DamagedFilesAreRefused) {
  const TestFolder folder;
  EXPECT_THROW(read_image(folder.write("a.png", "no picture")), ImageError);
  EXPECT_THROW(read_image(folder.write("a.exr", "")), ImageError);
  EXPECT_THROW(write_image("/nonexistent/a.png", gradient(2, 2), glm::dvec3(0)), ImageError);
}

TEST(PixelHash, DependsOnPixelsAndSize) {
  const Image image = gradient(4, 2);
  Image other = image;
  EXPECT_EQ(pixel_hash(image), pixel_hash(other));
  other.rgba[5] += 1e-6F;
  EXPECT_NE(pixel_hash(image), pixel_hash(other));
  EXPECT_NE(pixel_hash(Image(4, 2)), pixel_hash(Image(2, 4)));
}

}  // namespace
}  // namespace volumark
