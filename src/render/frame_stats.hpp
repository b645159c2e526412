#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace lutka::render {

/// The parts of drawing a frame, in their order.
enum class RenderPass {
    prepare,      ///< Culling, sorting, uploads of palettes and instances.
    shadow,       ///< The sun's shadow map.
    occlusion,    ///< Depth at half size, and ambient occlusion from it.
    opaque,       ///< Opaque figures and props, floor, backdrop.
    translucent,  ///< Blended materials, clear props and figures.
    debug,        ///< Line batch and solid batch.
    resolve       ///< Multisampling resolved into the picture.
};
inline constexpr std::size_t kRenderPassCount = 7;

/// Its name in lists, one word.
[[nodiscard]] constexpr std::string_view renderPassName(RenderPass pass) {
    constexpr std::array<std::string_view, kRenderPassCount> kNames = {"prepare",     "shadow", "occlusion", "opaque",
                                                                       "translucent", "debug",  "resolve"};
    return kNames[static_cast<std::size_t>(pass)];
}

/// Milliseconds that each pass took.
struct PassTimes {
    bool known = false;                         ///< False: nothing was measured yet, all are 0.
    std::array<double, kRenderPassCount> ms{};  ///< By RenderPass; 0 for a pass that did not run.

    [[nodiscard]] double operator[](RenderPass pass) const { return ms[static_cast<std::size_t>(pass)]; }
    [[nodiscard]] double total() const {
        double sum = 0.0;
        for (const double one : ms)
            sum += one;
        return sum;
    }
};

/// Bytes of GPU memory that the renderer asked the driver for.
struct GpuMemory {
    long long meshes = 0;    ///< Vertices and indices of characters and props.
    long long textures = 0;  ///< Of materials and environments, with their mipmaps.
    long long targets = 0;   ///< Picture (with its samples), shadow map, occlusion.
    long long streams = 0;   ///< Palettes, instances, debug batches, uniforms.

    [[nodiscard]] long long total() const { return meshes + textures + targets + streams; }
};

/// What drawing a frame cost.
struct FrameStats {
    int drawCalls = 0;            ///< All passes together.
    int characterDrawCalls = 0;   ///< Of those, skinned ones of the colour pass.
    int shadowDrawCalls = 0;      ///< Those of the shadow pass.
    int debugDrawCalls = 0;       ///< Those of the line batch and the solid batch.
    int instances = 0;            ///< Characters drawn.
    int culledInstances = 0;      ///< Characters outside the picture (they still cast their shadows).
    int droppedInstances = 0;     ///< Characters left out because the driver's texture buffers hold no more joints.
    int debugUploads = 0;         ///< Buffer uploads of debug geometry: one a batch that is not empty.
    long long triangles = 0;      ///< Submitted, all passes.
    long long uploadedBytes = 0;  ///< Palettes, instances, batches.
    double cpuMs = 0.0;           ///< Time spent in draw(), without waiting for the GPU.
    PassTimes cpu;                ///< The parts of cpuMs, this frame's.
    PassTimes gpu;  ///< By timer queries, of the newest frame whose results have arrived, some frames ago.
    GpuMemory memory;
};

}  // namespace lutka::render
