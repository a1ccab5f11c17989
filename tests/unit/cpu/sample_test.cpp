// The lane samplers of sample-inl.h against a scalar model in double, for every instruction set of this machine.
#include "backends/cpu/highway_targets.h"
// After it: everything of Highway.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/unit/cpu/sample_test.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "backends/cpu/sample-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumark {
namespace HWY_NAMESPACE {
namespace {

// uvw: three arrays of `count` floats; rgba: four. Both aligned, count a multiple of 16.
void sample_all(const CpuTexture& texture, const float* uvw, size_t count, float* rgba) {
  for_lanes(count, [&](size_t i) HWY_ATTR {
    const Floats u = load(uvw + i), v = load(uvw + count + i), w = load(uvw + 2 * count + i);
    const Rgba c = texture.dimension == 1   ? sample_1d(texture, u)
                   : texture.dimension == 2 ? sample_2d(texture, u, v)
                                            : sample_3d(texture, u, v, w);
    store(c.r, rgba + i);
    store(c.g, rgba + count + i);
    store(c.b, rgba + 2 * count + i);
    store(c.a, rgba + 3 * count + i);
  });
}

void sample_red(const CpuTexture& texture, const float* uvw, size_t count, float* red) {
  for_lanes(count, [&](size_t i) HWY_ATTR {
    store(sample_3d_red(texture, load(uvw + i), load(uvw + count + i), load(uvw + 2 * count + i)), red + i);
  });
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace volumark
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <gtest/gtest.h>
#include <hwy/aligned_allocator.h>

#include <array>
#include <random>

#include "backends/cpu/resources.h"
#include "backends/texel.h"

namespace volumark {
namespace {

HWY_EXPORT(sample_all);
HWY_EXPORT(sample_red);

constexpr size_t kSamples = 512;
using Colour = std::array<double, 4>;

// OpenGL 4.5 section 8.14, one axis: up to two texel indices with weights; -1 stands for the border.
struct Tap {
  int index;
  double weight;
};
std::vector<Tap> taps_of(const Sampler& sampler, double u, int n) {
  const auto wrapped = [&](long i) -> int {
    switch (sampler.wrap) {
      case Wrap::Clamp:
        return static_cast<int>(std::clamp<long>(i, 0, n - 1));
      case Wrap::Repeat:
        return static_cast<int>(((i % n) + n) % n);
      case Wrap::Border:
        break;
    }
    return i < 0 || i >= n ? -1 : static_cast<int>(i);
  };
  if (sampler.filter == Filter::Nearest) return {{wrapped(std::lround(std::floor(u * n))), 1}};
  const double at = u * n - 0.5, floor = std::floor(at);
  return {{wrapped(std::lround(floor)), 1 - (at - floor)}, {wrapped(std::lround(floor) + 1), at - floor}};
}

Colour model(const TextureDesc& desc, const Sampler& sampler, const std::array<double, 3>& p) {
  const std::vector<Tap> one{{0, 1}};
  const auto xs = taps_of(sampler, p[0], desc.width);
  const auto ys = desc.dimension > 1 ? taps_of(sampler, p[1], desc.height) : one;
  const auto zs = desc.dimension > 2 ? taps_of(sampler, p[2], desc.depth) : one;
  const bool alpha = channel_count(desc.format) == 4;
  Colour sum{};
  for (const Tap& z : zs) {
    for (const Tap& y : ys) {
      for (const Tap& x : xs) {
        std::array<float, 4> texel{0, 0, 0, alpha ? 0.0F : 1.0F};
        if (x.index >= 0 && y.index >= 0 && z.index >= 0) {
          const int at = x.index + desc.width * (y.index + desc.height * z.index);
          texel = decode_texel(desc.format, desc.data.data() + static_cast<size_t>(at) * texel_bytes(desc.format));
        }
        for (size_t c = 0; c < 4; ++c) sum[c] += x.weight * y.weight * z.weight * static_cast<double>(texel[c]);
      }
    }
  }
  return sum;
}

// Random texels; half floats and floats within [-2, 2].
std::vector<std::byte> random_texels(const TextureDesc& desc, std::mt19937& random) {
  const size_t count = static_cast<size_t>(desc.width * desc.height * desc.depth);
  std::vector<std::byte> data(count * texel_bytes(desc.format));
  const bool signed_values = desc.format == Format::R16F || desc.format == Format::R32F ||
                             desc.format == Format::RGBA16F || desc.format == Format::RGBA32F;
  std::uniform_real_distribution<float> value(signed_values ? -2.0F : 0.0F, signed_values ? 2.0F : 1.0F);
  for (size_t i = 0; i < count; ++i) {
    const std::array<float, 4> rgba{value(random), value(random), value(random), value(random)};
    encode_texel(desc.format, rgba, data.data() + i * texel_bytes(desc.format));
  }
  return data;
}

// Coordinates in and around the texture; where nearest filtering would hang on rounding they are moved off the border.
hwy::AlignedFreeUniquePtr<float[]> coordinates(std::mt19937& random, const TextureDesc& desc) {
  auto uvw = hwy::AllocateAligned<float>(3 * kSamples);
  const int extents[3] = {desc.width, desc.height, desc.depth};
  std::uniform_real_distribution<float> place(-0.75F, 1.75F);
  for (size_t i = 0; i < 3 * kSamples; ++i) {
    const auto n = static_cast<float>(extents[i / kSamples]);
    float u = place(random);
    while (std::abs(u * n - std::round(u * n)) < 1e-3F) u = place(random);
    uvw[i] = u;
  }
  return uvw;
}

class Samplers : public testing::TestWithParam<std::tuple<Format, int, Filter, Wrap>> {};

TEST_P(Samplers, AgreeWithTheModelOnEveryInstructionSet) {
  const auto [format, dimension, filter, wrap] = GetParam();
  std::mt19937 random(static_cast<unsigned>(format) * 7 + static_cast<unsigned>(dimension));
  TextureDesc desc;
  desc.format = format;
  desc.dimension = dimension;
  desc.width = 13;
  desc.height = dimension > 1 ? 7 : 1;
  desc.depth = dimension > 2 ? 5 : 1;
  const std::vector<std::byte> data = random_texels(desc, random);
  desc.data = data;
  const TextureStorage storage(desc, std::make_shared<MemoryBudget>(size_t{1} << 30));
  const Sampler sampler{filter, wrap};
  const CpuTexture texture = storage.view(sampler);
  const auto uvw = coordinates(random, desc);
  const auto rgba = hwy::AllocateAligned<float>(4 * kSamples);
  for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    HWY_DYNAMIC_DISPATCH(sample_all)(texture, uvw.get(), kSamples, rgba.get());
    for (size_t i = 0; i < kSamples; ++i) {
      const Colour expected = model(desc, sampler, {uvw[i], uvw[kSamples + i], uvw[2 * kSamples + i]});
      for (size_t c = 0; c < 4; ++c) {
        // Float coordinates resolve 2^-23 of 13 texels twice over, times a step of up to 4 a texel.
        ASSERT_NEAR(rgba[c * kSamples + i], expected[c], 2e-5) << hwy::TargetName(target) << " sample " << i;
      }
    }
    if (dimension == 3) {
      HWY_DYNAMIC_DISPATCH(sample_red)(texture, uvw.get(), kSamples, rgba.get());
      for (size_t i = 0; i < kSamples; ++i) {
        const Colour expected = model(desc, sampler, {uvw[i], uvw[kSamples + i], uvw[2 * kSamples + i]});
        ASSERT_NEAR(rgba[i], expected[0], 2e-5) << hwy::TargetName(target) << " red of sample " << i;
      }
    }
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

std::string name_of(const testing::TestParamInfo<Samplers::ParamType>& info) {
  const auto [format, dimension, filter, wrap] = info.param;
  const char* const wraps[] = {"clamp", "border", "repeat"};
  return std::string(to_string(format)) + "_" + std::to_string(dimension) + "d_" +
         (filter == Filter::Linear ? "linear_" : "nearest_") + wraps[static_cast<size_t>(wrap)];
}
INSTANTIATE_TEST_SUITE_P(All, Samplers,
                         testing::Combine(testing::Values(Format::R8, Format::R16, Format::R16F, Format::R32F,
                                                          Format::RG8, Format::RGBA8, Format::RGBA16F, Format::RGBA32F),
                                          testing::Values(1, 2, 3), testing::Values(Filter::Nearest, Filter::Linear),
                                          testing::Values(Wrap::Clamp, Wrap::Border, Wrap::Repeat)),
                         name_of);

TEST(OddCoordinates, NanAndHugeCoordinatesStayInside) {
  std::mt19937 random(1);
  TextureDesc desc;
  desc.format = Format::R32F;
  desc.dimension = 3;
  desc.width = desc.height = desc.depth = 4;
  const std::vector<std::byte> data = random_texels(desc, random);
  desc.data = data;
  const TextureStorage storage(desc, std::make_shared<MemoryBudget>(size_t{1} << 30));
  const auto uvw = hwy::AllocateAligned<float>(3 * 16);
  const auto rgba = hwy::AllocateAligned<float>(4 * 16);
  const float odd[] = {NAN, INFINITY, -INFINITY, 1e30F, -1e30F, 0, 1, 0.5F};
  for (size_t i = 0; i < 48; ++i) uvw[i] = odd[(i + i / 16) % 8];
  for (const Filter filter : {Filter::Nearest, Filter::Linear}) {
    for (const Wrap wrap : {Wrap::Clamp, Wrap::Border, Wrap::Repeat}) {
      const CpuTexture texture = storage.view({filter, wrap});
      HWY_DYNAMIC_DISPATCH(sample_all)(texture, uvw.get(), 16, rgba.get());  // reading outside is what asan would see
      HWY_DYNAMIC_DISPATCH(sample_red)(texture, uvw.get(), 16, rgba.get());
      if (filter == Filter::Linear && wrap == Wrap::Clamp) {
        for (size_t i = 0; i < 16; ++i) EXPECT_TRUE(rgba[i] >= -2 && rgba[i] <= 2) << i;
      }
    }
  }
}

}  // namespace
}  // namespace volumark
#endif
