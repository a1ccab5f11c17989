// The cache of references: what is damaged or belongs to something else is never used.
#include "harness/reference_cache.h"

#include <gtest/gtest.h>

#include <functional>

#include "scenes/scene_io.h"
#include "scenes/sha256.h"
#include "tests/unit/harness/test_folder.h"

namespace volumark {
namespace {

const std::string kKey(64, 'a');

Reference sample() {
  Reference reference;
  reference.image = Image(3, 2);
  for (size_t i = 0; i < reference.image.rgba.size(); ++i) reference.image.rgba[i] = static_cast<float>(i) / 7;
  reference.bound = {1e-7F, 2e-7F, 3e-7F, 4e-7F, 5e-7F, 6e-7F};
  reference.max_bound = 6e-7;
  reference.estimate = true;
  reference.undecided = 5;
  reference.cells = 11;
  reference.pieces = 22;
  return reference;
}

TEST(ReferenceCache, RoundTrip) {
  const TestFolder folder;
  const ReferenceCache cache(folder.path() / "deep" / "er");
  EXPECT_FALSE(cache.load(kKey));
  cache.store(kKey, sample());
  const auto back = cache.load(kKey);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->image.rgba, sample().image.rgba);
  EXPECT_EQ(back->image.width, 3);
  EXPECT_EQ(back->bound, sample().bound);
  EXPECT_EQ(back->max_bound, 6e-7);
  EXPECT_TRUE(back->estimate);
  EXPECT_EQ(back->undecided, 5);
  EXPECT_EQ(back->cells, 11);
  EXPECT_EQ(back->pieces, 22);
}

TEST(ReferenceCache, AnyFlippedByteAndAnyTruncationIsNoticed) {
  const TestFolder folder;
  const ReferenceCache cache(folder.path());
  cache.store(kKey, sample());
  const std::string good = text_of_file(cache.file_of(kKey));
  for (size_t i = 0; i < good.size(); ++i) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 0x10);
    folder.write(kKey + ".vmref", bad);
    EXPECT_FALSE(cache.load(kKey)) << "byte " << i;
  }
  for (size_t length = 0; length < good.size(); ++length) {
    folder.write(kKey + ".vmref", good.substr(0, length));
    EXPECT_FALSE(cache.load(kKey)) << "length " << length;
  }
  folder.write(kKey + ".vmref", good + "x");
  EXPECT_FALSE(cache.load(kKey));
  folder.write(std::string(64, 'b') + ".vmref", good);  // another key's file
  EXPECT_FALSE(cache.load(std::string(64, 'b')));
  folder.write(kKey + ".vmref", good);
  EXPECT_TRUE(cache.load(kKey));
}

// Whole, with a hash that fits: but of another version of the integrator, or of the file.
TEST(ReferenceCache, AFileOfAnotherVersionIsNotUsed) {
  const TestFolder folder;
  const ReferenceCache cache(folder.path());
  cache.store(kKey, sample());
  const std::string good = text_of_file(cache.file_of(kKey));
  const size_t payload = sample().bound.size() * 5 * sizeof(float);
  const size_t head = good.size() - payload - 64;
  const auto with = [&](size_t byte, int change) {
    std::string front = good.substr(0, head), back = good.substr(head + 64);
    front[byte] = static_cast<char>(front[byte] + change);
    folder.write(kKey + ".vmref", front + sha256_hex(front + back) + back);
    return cache.load(kKey).has_value();
  };
  EXPECT_TRUE(with(0, 0));
  EXPECT_FALSE(with(8, 1));    // of the file
  EXPECT_FALSE(with(12, 1));   // of the integrator
  EXPECT_FALSE(with(12, -1));  // an older one
}

TEST(ReferenceCache, ATruncatedFileOrAFlippedBitIsMadeAnew) {
  const TestFolder folder;
  const ReferenceCache cache(folder.path());
  Scene scene = load_scene("slab");
  load_data(scene, {});
  const Reference first = cache.get(scene, scene.views[0], 8, 6, {});
  const std::string name = reference_key(scene, scene.views[0], 8, 6, {}) + ".vmref";
  const std::string good = text_of_file(folder.path() / name);
  std::string flipped = good;
  flipped[good.size() - 100] = static_cast<char>(flipped[good.size() - 100] ^ 1);
  for (const std::string& bad : {good.substr(0, good.size() / 2), flipped}) {
    folder.write(name, bad);
    bool cached = true;
    EXPECT_EQ(cache.get(scene, scene.views[0], 8, 6, {}, &cached).image.rgba, first.image.rgba);
    EXPECT_FALSE(cached);
    EXPECT_EQ(text_of_file(folder.path() / name), good) << "it was not written again";
  }
}

TEST(ReferenceCache, ADamagedFileIsMadeAnew) {
  const TestFolder folder;
  const ReferenceCache cache(folder.path());
  Scene scene = load_scene("slab");
  load_data(scene, {});
  bool cached = true;
  const Reference first = cache.get(scene, scene.views[0], 8, 6, {}, &cached);
  EXPECT_FALSE(cached);
  cache.get(scene, scene.views[0], 8, 6, {}, &cached);
  EXPECT_TRUE(cached);
  folder.write(reference_key(scene, scene.views[0], 8, 6, {}) + ".vmref", "rubbish");
  const Reference again = cache.get(scene, scene.views[0], 8, 6, {}, &cached);
  EXPECT_FALSE(cached);
  EXPECT_EQ(again.image.rgba, first.image.rgba);
  EXPECT_TRUE(cache.load(reference_key(scene, scene.views[0], 8, 6, {})));
}

TEST(ReferenceCache, AFolderThatCannotBeWrittenCostsOnlyTime) {
  Scene scene = load_scene("slab");
  load_data(scene, {});
  const ReferenceCache cache("/proc/nonexistent");
  EXPECT_EQ(cache.get(scene, scene.views[0], 4, 4, {}).image.width, 4);
}

TEST(ReferenceKey, ChangesWithEverythingThePictureDependsOn) {
  Scene scene = load_scene("slab");
  load_data(scene, {});
  const View view = scene.views[0];
  const std::string key = reference_key(scene, view, 8, 8, {});
  EXPECT_EQ(key, reference_key(scene, view, 8, 8, {}));
  EXPECT_NE(key, reference_key(scene, view, 8, 9, {}));
  ReferenceOptions options;
  options.tolerance *= 2;
  EXPECT_NE(key, reference_key(scene, view, 8, 8, options));
  options = {};
  options.threads = 3;  // the picture does not depend on it
  EXPECT_EQ(key, reference_key(scene, view, 8, 8, options));
  for (const auto& change : std::vector<std::function<void(View&)>>{
           [](View& v) { v.eye.x += 1e-12; }, [](View& v) { v.target.y += 1; }, [](View& v) { v.up.x += 1; },
           [](View& v) { v.perspective = !v.perspective; }, [](View& v) { v.fov_y += 1; },
           [](View& v) { v.half_height += 1; }, [](View& v) { v.near += 1; }}) {
    View other = view;
    change(other);
    EXPECT_NE(key, reference_key(scene, other, 8, 8, {}));
  }
  scene.hash += "0";
  EXPECT_NE(key, reference_key(scene, view, 8, 8, {}));
}

}  // namespace
}  // namespace volumark
