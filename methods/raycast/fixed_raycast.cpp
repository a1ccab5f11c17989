#include "methods/raycast/fixed_raycast.h"

#include <algorithm>
#include <bit>

#include "methods/raycast/bricks.h"
#include "programs/raycast_fixed_frag.h"
#include "programs/raycast_vert.h"

namespace volumark {
namespace {

// Bricks of texels whose palette entries are transparent over the whole range of their values. The filter stays between
// its eight texels, so that a sample inside has such an entry too.
struct LevelBricks {
  glm::ivec3 count{1};
  int shift = 0;  // a brick is 2^shift texels wide
  BrickDistances distances{{0}, 1};
};
LevelBricks level_bricks(const glm::ivec3& size, std::span<const uint8_t> texels, std::span<const uint8_t> palette,
                         int brick_size) {
  Volume values;  // the value is a texel's last channel
  values.size = size;
  values.voxels.resize(static_cast<size_t>(size.x) * static_cast<size_t>(size.y) * static_cast<size_t>(size.z));
  const size_t channels = texels.size() / values.voxels.size();
  for (size_t i = 0; i < values.voxels.size(); ++i) values.voxels[i] = std::byte{texels[(i + 1) * channels - 1]};
  LevelBricks out;
  out.shift = std::bit_width(static_cast<uint32_t>(brick_size)) - 1;
  const BrickRanges ranges = brick_ranges(values, 1 << out.shift);
  out.count = ranges.count;
  std::vector<int> opaque_before(257);
  for (size_t level = 0; level < 256; ++level) {
    opaque_before[level + 1] = opaque_before[level] + (palette[4 * level + 3] > 0 ? 1 : 0);
  }
  std::vector<uint8_t> occupied(ranges.lo.size());
  for (size_t i = 0; i < occupied.size(); ++i) {
    occupied[i] =
        opaque_before[static_cast<size_t>(ranges.hi[i]) + 1] > opaque_before[static_cast<size_t>(ranges.lo[i])];
  }
  out.distances = brick_distances(ranges.count, occupied);
  return out;
}

class PreparedFixedRaycast final : public PreparedMethod {
 public:
  PreparedFixedRaycast(const Scene& scene, const FixedSettings& settings, const FixedRaySettings& rays,
                       std::span<const uint8_t> texels, std::span<const uint8_t> palette, Device& device)
      : scene_(scene),
        device_(device),
        step_(settings.step),
        // Below one level nothing passes: what is left then is 0.
        end_levels_(static_cast<float>(std::max(255 * rays.early_termination, 0.5))),
        resources_(scene, texels, palette, device) {
    create_distances(texels, palette, rays.brick_size);
    uniforms_ = device_.create_buffer({.label = "raycast uniforms", .size = sizeof(FixedUniforms), .data = {}});
    ProgramDesc program;
    program.label = "raycast, fixed point";
    program.stages = {&programs::raycast_vert, &programs::raycast_fixed_frag};
    program.bindings = FixedResources::declarations();
    program.bindings.push_back({3, BindingKind::Sampled, 3});
    program.constants = FixedResources::constants(scene, settings);
    program.constants.push_back({"VM_SKIP_EMPTY", rays.brick_size > 0 ? 1 : 0});
    program.cpu = &raycast_fixed_cpu;
    program_ = device_.create_program(program);
    PipelineDesc pipeline;
    pipeline.label = program.label;
    pipeline.program = program_;
    pipeline.colour_format = Format::RGBA8;
    pipeline_ = device_.create_pipeline(pipeline);
  }
  ~PreparedFixedRaycast() override {
    device_.destroy(pipeline_);
    device_.destroy(program_);
    device_.destroy(uniforms_);
    device_.destroy(distances_);
  }
  PreparedFixedRaycast(const PreparedFixedRaycast&) = delete;
  PreparedFixedRaycast& operator=(const PreparedFixedRaycast&) = delete;

  void render(const View& view, Device& device, Texture target) override {
    const TextureDesc& image = device.desc(target);
    device.begin_zone("upload");
    FixedUniforms uniforms = fixed_uniforms(scene_, view, image.width, image.height, step_);
    const ViewRays rays = view_rays(*scene_.volume, view, image.width, image.height);
    // In perspective, rays beside the middle are longer than the volume is deep; their last sample is found by its
    // place.
    uniforms.limit[3] = rays.perspective ? 4e6F : static_cast<float>(fixed_depths(*scene_.volume, rays, step_).count);
    uniforms.lighting[3] = end_levels_;
    for (int axis = 0; axis < 3; ++axis) {
      uniforms.bricks[static_cast<size_t>(axis)] = static_cast<float>(bricks_.count[axis] - 1);
    }
    uniforms.bricks[3] = static_cast<float>(bricks_.shift);
    device.update_buffer(uniforms_, 0, bytes_of(uniforms));
    device.end_zone();

    device.begin_zone("raster");
    device.begin_pass({.label = "raycast", .colour = target, .depth_stencil = {}});
    DrawDesc draw;
    draw.pipeline = pipeline_;
    draw.bindings = resources_.bindings(uniforms_);
    draw.bindings.push_back(bind_sampled(3, distances_, {Filter::Nearest, Wrap::Clamp}));
    draw.count = 3;
    device.draw(draw);
    device.end_pass();
    device.end_zone();
    counters_["rays"] = static_cast<int64_t>(image.width) * image.height;
  }
  Counters counters() const override { return counters_; }

 private:
  // Where nothing is skipped the program still names the texture: one brick.
  void create_distances(std::span<const uint8_t> texels, std::span<const uint8_t> palette, int brick_size) {
    if (brick_size > 0) {
      device_.begin_zone("classify");
      bricks_ = level_bricks(scene_.volume->size, texels, palette, brick_size);
      device_.end_zone();
      counters_["bricks"] = static_cast<int64_t>(bricks_.distances.distance.size());
      counters_["bricks_occupied"] = bricks_.distances.occupied;
    }
    const std::vector<uint8_t>& distance = bricks_.distances.distance;
    distances_ = device_.create_texture({.label = "brick distances",
                                         .dimension = 3,
                                         .format = Format::R8,
                                         .width = bricks_.count.x,
                                         .height = bricks_.count.y,
                                         .depth = bricks_.count.z,
                                         .data = bytes_of(distance)});
    counters_["texture_bytes"] = static_cast<int64_t>(resources_.texture_bytes() + distance.size());
  }

  Scene scene_;  // shares the volume
  Device& device_;
  double step_;  // world units
  float end_levels_;
  FixedResources resources_;
  LevelBricks bricks_;
  Texture distances_;
  Buffer uniforms_;
  Program program_;
  Pipeline pipeline_;
  Counters counters_;
};

}  // namespace

std::unique_ptr<PreparedMethod> prepare_fixed_raycast(const Scene& scene, const FixedSettings& settings,
                                                      const FixedRaySettings& rays, Device& device) {
  return std::make_unique<PreparedFixedRaycast>(scene, settings, rays, fixed_texels(scene, settings),
                                                fixed_palette(scene, settings), device);
}

}  // namespace volumark
