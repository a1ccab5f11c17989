#include "methods/volume/volume_resources.h"

#include <gtest/gtest.h>

#include "backends/backend.h"
#include "test_scene.h"

namespace volumark {
namespace {

Device null_device() { return Device(make_null_backend({})); }

VolumeSettings settings(const char* format, Classification classification = Classification::Post) {
  VolumeSettings settings;
  settings.volume_format = format;
  settings.classification = classification;
  settings.segment = 0.1;
  return settings;
}

TEST(VolumeResources, NativeFormatsNormaliseByTheWindow) {
  Device device = null_device();
  Volume u8 = testing::volume_of<uint8_t>({2, 1, 1}, VoxelType::U8, {0, 255});
  const VolumeResources plain(testing::scene_of(u8, 0, 255), settings("native"), device);
  EXPECT_EQ(device.desc(plain.volume()).format, Format::R8);
  EXPECT_EQ(plain.value_origin(), 0.F) << "raw where the window is the range: no rounding at all";
  EXPECT_EQ(plain.value_scale(), 1.F);

  u8.slope = 2;
  u8.intercept = -100;
  const VolumeResources scaled(testing::scene_of(u8, 50, 150), settings("native"), device);
  const auto s_n = [](const VolumeResources& r, double stored) {
    return (stored - r.value_origin()) * r.value_scale();
  };
  EXPECT_NEAR(s_n(scaled, 100 / 255.), 0.5, 1e-6);  // data value 100
  EXPECT_NEAR(s_n(scaled, 75 / 255.), 0, 1e-6);

  const Volume i16 = testing::volume_of<int16_t>({2, 1, 1}, VoxelType::I16, {-1000, 3000});
  const VolumeResources ct(testing::scene_of(i16, -1000, 1000), settings("native"), device);
  EXPECT_EQ(device.desc(ct.volume()).format, Format::R16);
  EXPECT_NEAR(s_n(ct, (0 + 32768) / 65535.), 0.5, 1e-5);
  EXPECT_NEAR(s_n(ct, (-1000 + 32768) / 65535.), 0, 1e-5);

  const Volume f32 = testing::volume_of<float>({2, 1, 1}, VoxelType::F32, {-1.F, 3.F});
  const VolumeResources field(testing::scene_of(f32, -1, 3), settings("native"), device);
  EXPECT_EQ(device.desc(field.volume()).format, Format::R32F);
  EXPECT_NEAR(s_n(field, 1), 0.5, 1e-6);
}

TEST(VolumeResources, ConvertedFormats) {
  Device device = null_device();
  const Scene scene = testing::scene_of(testing::volume_of<float>({2, 1, 1}, VoxelType::F32, {-1.F, 3.F}), 0, 2);
  for (const auto& [name, format] : {std::pair{"r8", Format::R8}, {"r16", Format::R16}, {"r16f", Format::R16F}}) {
    const VolumeResources converted(scene, settings(name), device);
    EXPECT_EQ(device.desc(converted.volume()).format, format);
    // Integer texels span the data: 0 is -1, 1 is 3; float texels hold the normalised value.
    const bool unorm = format != Format::R16F;
    EXPECT_FLOAT_EQ((0.F - converted.value_origin()) * converted.value_scale(), unorm ? -0.5F : 0.F);
    EXPECT_FLOAT_EQ((1.F - converted.value_origin()) * converted.value_scale(), unorm ? 1.5F : 1.F);
  }
}

TEST(VolumeResources, PreClassifiedVolumesAreColours) {
  Device device = null_device();
  const Scene scene = testing::scene_of(testing::volume_of<uint8_t>({2, 1, 1}, VoxelType::U8, {0, 255}));
  for (const auto& [name, format] :
       {std::pair{"native", Format::RGBA8}, {"r16", Format::RGBA16F}, {"r32f", Format::RGBA32F}}) {
    const VolumeResources classified(scene, settings(name, Classification::Pre), device);
    EXPECT_EQ(device.desc(classified.volume()).format, format);
  }
}

TEST(VolumeResources, GivesBackWhatItTook) {
  Device device = null_device();
  const Scene scene = testing::scene_of(testing::volume_of<uint8_t>({2, 1, 1}, VoxelType::U8, {0, 255}));
  const size_t before = device.live_bytes();
  {
    const VolumeResources resources(scene, settings("native", Classification::Preintegrated), device);
    EXPECT_EQ(resources.texture_bytes(), 2U + 1021 * 16 + 256 * 256 * 16);
    EXPECT_EQ(device.live_bytes() - before, resources.texture_bytes());
  }
  EXPECT_EQ(device.live_bytes(), before);
}

}  // namespace
}  // namespace volumark
