// A method made ready on a Device of its own, and the timed frame: the one function that experiments and benchmarks
// share. A frame is timed from the first call of render to the end of submit_and_wait, with the image resident.
#pragma once

#include <memory>
#include <vector>

#include "backends/device.h"
#include "harness/clock.h"
#include "methods/method.h"
#include "scenes/image.h"

namespace volumark {

struct FrameCost {
  Instant cost;
  std::vector<ZoneTime> zones;
};

class FrameSource {
 public:
  // Prepares the method (timed in prepare_cost(), with everything it uploads) and makes the target. Throws what they
  // throw.
  FrameSource(const Scene& scene, const Method& method, const Values& values, Device& device, int width, int height);
  ~FrameSource();
  FrameSource(const FrameSource&) = delete;

  FrameCost frame(const View& view);
  Image read_back();  // of the last frame
  Counters counters() const { return prepared_->counters(); }
  const FrameCost& prepare_cost() const { return prepare_; }
  size_t target_bytes() const;

 private:
  Device& device_;
  FrameCost prepare_;
  std::unique_ptr<PreparedMethod> prepared_;
  Texture target_;
};

// Texels of any colour format as an image.
Image decode_image(Format format, int width, int height, std::span<const std::byte> texels);

}  // namespace volumark
