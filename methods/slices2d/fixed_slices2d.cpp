#include "methods/slices2d/fixed_slices2d.h"

#include <fmt/format.h>

#include <algorithm>

#include "programs/slices2d_fixed_frag.h"
#include "programs/slices2d_vert.h"

namespace volumark {
namespace {

// The three stacks with their palettes. Owns them; dies before the Device.
class FixedStacks {
 public:
  FixedStacks(const Scene& scene, const SliceSettings& slices, Classification classification, bool linear_opacity,
              Device& device)
      : device_(device) {
    // The destructor does not run when a constructor throws.
    try {
      for (int axis = 0; axis < 3; ++axis)
        add(scene, {classification, linear_opacity, slab_thickness(*scene.volume, axis, slices.percent)}, axis);
    } catch (...) {
      release();
      throw;
    }
  }
  ~FixedStacks() { release(); }
  FixedStacks(const FixedStacks&) = delete;
  FixedStacks& operator=(const FixedStacks&) = delete;

  const StackLayout& layout(int axis) const { return stacks_[static_cast<size_t>(axis)].layout; }
  static std::vector<BindingDecl> declarations() {
    return {{0, BindingKind::Uniform, 0},
            {1, BindingKind::Sampled, 2},
            {2, BindingKind::Sampled, 1},
            {3, BindingKind::Uniform, 0}};
  }
  std::vector<Binding> bindings(int axis, int page) const {
    constexpr Sampler kTexels{Filter::Nearest, Wrap::Clamp};  // filtering is the program's own
    const Stack& stack = stacks_[static_cast<size_t>(axis)];
    return {bind_sampled(1, stack.pages[static_cast<size_t>(page)], kTexels), bind_sampled(2, stack.palette, kTexels)};
  }
  size_t texture_bytes() const { return texture_bytes_; }

 private:
  struct Stack {
    StackLayout layout;
    std::vector<Texture> pages;
    Texture palette;
  };

  Texture create(const TextureDesc& desc) {
    texture_bytes_ += desc.data.size();
    return device_.create_texture(desc);
  }
  void add(const Scene& scene, const FixedSettings& settings, int axis) {
    const glm::ivec3 size = scene.volume->size;
    Stack& stack = stacks_[static_cast<size_t>(axis)];
    stack.layout = stack_layout(size, axis, device_.info().limits.texture_2d).value();
    // Opacities are those of the stack's own slabs, so pre-classified texels are, too.
    const std::vector<uint8_t> texels = fixed_texels(scene, settings), palette = fixed_palette(scene, settings);
    const size_t texel = settings.classification == Classification::Pre ? 4 : 1;
    for (const StackPage& page : stack.layout.pages) {
      const std::vector<std::byte> data =
          page_texels(stack.layout, page, size, std::as_bytes(std::span(texels)), texel);
      const glm::ivec2 extent = stack.layout.extent(page);
      stack.pages.push_back(
          create({.label = fmt::format("8-bit stack {}, slices {} to {}", "ijk"[axis], page.first, page.last),
                  .format = texel == 4 ? Format::RGBA8 : Format::R8,
                  .width = extent.x,
                  .height = extent.y,
                  .data = data}));
    }
    stack.palette = create({.label = fmt::format("palette of stack {}", "ijk"[axis]),
                            .dimension = 1,
                            .format = Format::RGBA8,
                            .width = 256,
                            .data = std::as_bytes(std::span(palette))});
  }
  void release() {
    for (const Stack& stack : stacks_) {
      for (const Texture page : stack.pages) device_.destroy(page);
      if (stack.palette) device_.destroy(stack.palette);
    }
  }

  Device& device_;
  std::array<Stack, 3> stacks_;
  size_t texture_bytes_ = 0;
};

// Uniform blocks lie this far apart.
constexpr size_t kBlock = 256;
static_assert(sizeof(FixedSliceUniforms) <= kBlock);

class PreparedFixedSlices2d final : public PreparedMethod {
 public:
  PreparedFixedSlices2d(const Scene& scene, const SliceSettings& settings, Classification classification,
                        bool linear_opacity, Device& device)
      : scene_(scene),
        settings_(settings),
        device_(device),
        stacks_(scene, settings, classification, linear_opacity, device),
        frame_(device, "frame uniforms"),
        pages_(device, "page uniforms"),
        vertices_(device, "slice vertices"),
        indices_(device, "slice indices") {
    ProgramDesc program;
    program.label = "slices2d, fixed point";
    program.stages = {&programs::slices2d_vert, &programs::slices2d_fixed_frag};
    program.bindings = FixedStacks::declarations();
    program.constants = FixedResources::constants(scene, {classification, linear_opacity, 1});
    program.constants.push_back({"VM_TEXTURES", settings.textures});
    program.constants.push_back({"VM_INTERPOLATE", settings.interpolate ? 1 : 0});
    program.constants.push_back({"VM_CORRECTED", settings.corrected ? 1 : 0});
    program.cpu = &slices2d_fixed_twin;
    program_ = device.create_program(program);
    PipelineDesc pipeline;
    pipeline.label = program.label;
    pipeline.program = program_;
    pipeline.vertex_layouts = {{sizeof(PolygonVertex), false, {{0, 2, 0}, {1, 2, offsetof(PolygonVertex, first)}}}};
    pipeline.blend = Blend::Over;
    pipeline.colour_format = Format::RGBA8;
    pipeline_ = device.create_pipeline(pipeline);
  }
  ~PreparedFixedSlices2d() override {
    device_.destroy(pipeline_);
    device_.destroy(program_);
  }
  PreparedFixedSlices2d(const PreparedFixedSlices2d&) = delete;
  PreparedFixedSlices2d& operator=(const PreparedFixedSlices2d&) = delete;

  void render(const View& view, Device& device, Texture target) override;
  Counters counters() const override { return counters_; }

 private:
  void build(const ViewRays& rays, int axis, const Slices& slices, int width, int height);

  Scene scene_;  // shares the volume
  SliceSettings settings_;
  Device& device_;
  FixedStacks stacks_;
  GrowingBuffer frame_, pages_, vertices_, indices_;
  Program program_;
  Pipeline pipeline_;
  SliceGroupMesh mesh_;
  Counters counters_;
};

// Polygons cover every pixel that may have a sample inside, and a few beside it: the program decides which have, since
// rasterizers move corners to grids of their own.
void PreparedFixedSlices2d::build(const ViewRays& rays, int axis, const Slices& slices, int width, int height) {
  constexpr double kSlack = 0.02;  // texels; positions are rounded to 1/256
  const Volume& volume = *scene_.volume;
  const ViewRays stack_rays = turned(rays, axis);
  const glm::dvec3 extent = turned(volume.extent(), axis), covered = extent + turned(2 * kSlack * volume.spacing, axis);
  const std::vector<SliceGroup> groups =
      slice_groups(slices, stacks_.layout(axis), stack_rays, extent, settings_.textures);
  build_groups(slices, groups, stack_rays, covered, settings_.corrected, {1.5 / width, 1.5 / height}, mesh_);
  counters_ = {{"stack_axis", axis},
               {"slices", slices.count},
               {"polygons", mesh_.polygons},
               {"vertices", static_cast<int64_t>(mesh_.vertices.size())},
               {"draws", static_cast<int64_t>(mesh_.runs.size())},
               {"texture_bytes", static_cast<int64_t>(stacks_.texture_bytes())}};
}

std::vector<std::byte> page_blocks_of(const StackLayout& layout, const Slices& slices, const ViewRays& rays) {
  // Texel coordinates; along a stack of one slice the box is one cell wide (FixedUniforms).
  const int cells = std::max(slices.stored - 1, 1);
  FixedSliceUniforms uniforms;
  uniforms.slices = {static_cast<float>(slices.first * cells), static_cast<float>(slices.distance * cells),
                     static_cast<float>(rays.z_near), 0};
  std::vector<std::byte> blocks(kBlock * layout.pages.size());
  for (size_t i = 0; i < layout.pages.size(); ++i) {
    const StackPage& page = layout.pages[i];
    uniforms.tiles = {static_cast<float>(page.columns), static_cast<float>(page.first),
                      static_cast<float>(layout.tile().x), static_cast<float>(layout.tile().y)};
    const std::span<const std::byte> block = bytes_of(uniforms);
    std::copy(block.begin(), block.end(), blocks.begin() + static_cast<ptrdiff_t>(kBlock * i));
  }
  return blocks;
}

void PreparedFixedSlices2d::render(const View& view, Device& device, Texture target) {
  const int width = device.desc(target).width, height = device.desc(target).height;
  device.begin_zone("classify");
  const ViewRays rays = view_rays(*scene_.volume, view, width, height);
  const int axis = best_stack(*scene_.volume, rays);
  const Slices slices = slices_of(stacks_.layout(axis).slices, settings_.percent);
  build(rays, axis, slices, width, height);
  device.end_zone();
  DrawDesc draw;
  Buffer frame, pages;
  if (!mesh_.indices.empty()) {
    device.begin_zone("upload");
    frame = frame_.upload(bytes_of(turned(fixed_uniforms(scene_, view, width, height, 1), axis)));
    pages = pages_.upload(page_blocks_of(stacks_.layout(axis), slices, rays));
    draw.pipeline = pipeline_;
    draw.vertex_buffers = {vertices_.upload(bytes_of(mesh_.vertices))};
    draw.index_buffer = indices_.upload(bytes_of(mesh_.indices));
    device.end_zone();
  }
  device.begin_zone("raster");
  PassDesc pass;
  pass.label = "slices";
  pass.colour = target;
  device.begin_pass(pass);
  for (const SliceRun& run : mesh_.runs) {
    draw.bindings = stacks_.bindings(axis, run.page);
    draw.bindings.push_back(bind_uniform(0, frame));
    draw.bindings.push_back(bind_uniform(3, pages, kBlock * static_cast<size_t>(run.page), sizeof(FixedSliceUniforms)));
    draw.first = run.first_index;
    draw.count = run.index_count;
    device.draw(draw);
  }
  device.end_pass();
  device.end_zone();
}

}  // namespace

FixedUniforms turned(const FixedUniforms& uniforms, int axis) {
  FixedUniforms out = uniforms;
  for (Float4 FixedUniforms::*member :
       {&FixedUniforms::origin, &FixedUniforms::origin_x, &FixedUniforms::origin_y, &FixedUniforms::direction,
        &FixedUniforms::direction_x, &FixedUniforms::direction_y, &FixedUniforms::metric, &FixedUniforms::limit,
        &FixedUniforms::last}) {
    out.*member = turned(uniforms.*member, axis);
  }
  for (Float4& plane : out.clip_planes) plane = turned(plane, axis);
  for (FixedLight& light : out.lights) {
    light.direction = turned(light.direction, axis);
    light.half = turned(light.half, axis);
  }
  return out;
}

double slab_thickness(const Volume& volume, int axis, int64_t percent) {
  return slices_of(volume.size[axis], percent).distance * volume.extent()[axis];
}

std::unique_ptr<PreparedMethod> prepare_fixed_slices2d(const Scene& scene, const SliceSettings& settings,
                                                       Classification classification, bool linear_opacity,
                                                       Device& device) {
  return std::make_unique<PreparedFixedSlices2d>(scene, settings, classification, linear_opacity, device);
}

}  // namespace volumark
