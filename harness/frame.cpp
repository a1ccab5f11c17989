#include "harness/frame.h"

#include <cstring>

#include "backends/texel.h"

namespace volumark {

FrameSource::FrameSource(const Scene& scene, const Method& method, const Values& values, Device& device, int width,
                         int height)
    : device_(device) {
  const Instant start = now();
  prepared_ = method.prepare(scene, values, device);
  prepare_.zones = device.submit_and_wait();
  prepare_.cost = since(start);
  TextureDesc desc;
  desc.label = "frame target";
  desc.format = volumark::target_format(method, scene, values);
  desc.width = width;
  desc.height = height;
  desc.target = true;
  target_ = device.create_texture(desc);
}

FrameSource::~FrameSource() {
  prepared_.reset();
  try {
    device_.destroy(target_);
  } catch (const DeviceError&) {  // a lost device has nothing left to destroy
  }
}

FrameCost FrameSource::frame(const View& view) {
  FrameCost out;
  const Instant start = now();
  try {
    prepared_->render(view, device_, target_);
    out.zones = device_.submit_and_wait();
  } catch (...) {
    device_.abandon();  // or nothing that was prepared could be destroyed
    throw;
  }
  out.cost = since(start);
  return out;
}

Image FrameSource::read_back() {
  const TextureDesc& desc = device_.desc(target_);
  return decode_image(desc.format, desc.width, desc.height, device_.read_texture(target_));
}

size_t FrameSource::target_bytes() const {
  const TextureDesc& desc = device_.desc(target_);
  return static_cast<size_t>(desc.width) * static_cast<size_t>(desc.height) * texel_bytes(desc.format);
}

Image decode_image(Format format, int width, int height, std::span<const std::byte> texels) {
  Image image(width, height);
  if (format == Format::RGBA32F) {
    std::memcpy(image.rgba.data(), texels.data(), image.rgba.size() * sizeof(float));
    return image;
  }
  const size_t bytes = texel_bytes(format);
  for (size_t i = 0; i < image.rgba.size() / 4; ++i) {
    const std::array<float, 4> texel = decode_texel(format, texels.data() + i * bytes);
    std::copy(texel.begin(), texel.end(), image.rgba.begin() + static_cast<std::ptrdiff_t>(i * 4));
  }
  return image;
}

}  // namespace volumark
