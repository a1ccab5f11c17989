#include "scenes/procedural_textures.h"

#include <cstring>
#include <stdexcept>

#include "helpers.h"

namespace volumark {
namespace {

TextureSpec small(const char* kind, uint32_t seed = 3) { return {kind, glm::ivec3(48), seed, 1}; }

TEST(ProceduralTextures, AllAreSeededOpaqueSomewhereAndEmptyAbove) {
  for (const char* kind : texture_kinds()) {
    const ShellTexture texture = make_texture(small(kind)), again = make_texture(small(kind));
    ASSERT_EQ(texture.texels.size(), 48u * 48u * 48u) << kind;
    EXPECT_TRUE(texture.texels == again.texels) << kind;
    EXPECT_FALSE(texture.texels == make_texture(small(kind, 4)).texels) << kind;
    size_t opaque = 0, empty = 0;
    for (const glm::vec4& t : texture.texels) {
      opaque += t.a > 0.95f ? 1 : 0;
      empty += t.a == 0 ? 1 : 0;
      for (int c = 0; c < 3; ++c) {
        EXPECT_GE(t[c], 0) << kind;
        EXPECT_LE(t[c], 1.5f * t.a + 1e-6f) << kind;  // a colour times the extinction
      }
      EXPECT_LE(t.a, 1.0f + 1e-6f) << kind;
    }
    EXPECT_GT(opaque, texture.texels.size() / 100) << kind;
    EXPECT_GT(empty, texture.texels.size() / 4) << kind;
  }
}

// Those of the paper that let light through have such texels, in a body of them.
TEST(ProceduralTextures, SemiTransparentParts) {
  for (const char* kind : {"egg_torus", "outdoor", "volcano"}) {
    const ShellTexture texture = make_texture(small(kind));
    size_t through = 0;
    for (const glm::vec4& t : texture.texels) through += t.a > 0.0005f && t.a < 0.25f ? 1 : 0;
    EXPECT_GT(through, texture.texels.size() / 100) << kind;
  }
}

// What crosses a border goes on at the other side: the step there is no larger than the largest
// inside.
TEST(ProceduralTextures, RepeatAlongUAndV) {
  for (const char* kind : texture_kinds()) {
    const ShellTexture texture = make_texture(small(kind));
    const int n = texture.size.x;
    for (const bool along_u : {true, false}) {
      std::vector<double> steps(static_cast<size_t>(n));  // from one layer across the axis to the next
      for (int i = 0; i < n; ++i) {
        for (int k = 0; k < n; ++k) {
          for (int j = 0; j < n; ++j) {
            const glm::vec4 &here = along_u ? texture.texel(i, j, k) : texture.texel(j, i, k),
                            &next = along_u ? texture.texel(i + 1, j, k) : texture.texel(j, i + 1, k);
            steps[static_cast<size_t>(i)] += static_cast<double>(std::abs(next.a - here.a));
          }
        }
      }
      const double seam = steps.back();
      steps.pop_back();
      EXPECT_LE(seam, *std::max_element(steps.begin(), steps.end())) << kind << (along_u ? " u" : " v");
    }
  }
}

TEST(ProceduralTextures, AnySizeWithoutACube) {
  const ShellTexture texture = make_texture({"fur", {16, 8, 4}, 1, 2});
  EXPECT_EQ(texture.texels.size(), 16u * 8u * 4u);
  EXPECT_NO_THROW(make_texture({"volcano", {1, 1, 1}, 1, 2}));
}

TEST(ProceduralTextures, RefuseUnknownKindsAndSizes) {
  EXPECT_THROW(make_texture({"nothing", glm::ivec3(8), 1, 1}), std::invalid_argument);
  EXPECT_THROW(make_texture({"fur", {8, 0, 8}, 1, 1}), std::invalid_argument);
  EXPECT_THROW(make_texture({"fur", {8, 8, 1025}, 1, 1}), std::invalid_argument);
}

}  // namespace
}  // namespace volumark
