#pragma once

#include <array>
#include <chrono>

#include "render/frame.hpp"
#include "render/gl/gl_object.hpp"

namespace lutka::render {

struct QueryTraits {
    static GLuint create() {
        GLuint name = 0;
        glGenQueries(1, &name);
        return name;
    }
    static void destroy(GLuint name) { glDeleteQueries(1, &name); }
};
using GlQuery = GlObject<QueryTraits>;

/// Times each pass of a frame on the CPU and, by timer queries, on the GPU. Results of the GPU are fetched when they
/// are there, some frames later, and never waited for: a frame for which no set of queries is free is not measured.
class PassTimer {
  public:
    PassTimer();

    /// Fetches what is there and starts a frame; the GPU's times of the newest frame known go to stats.gpu.
    void beginFrame(FrameStats& stats);
    /// Ends the pass before, if any, and starts this one. Each pass once a frame.
    void begin(RenderPass pass, FrameStats& stats);
    /// Ends the last pass.
    void endFrame(FrameStats& stats);

  private:
    using Clock = std::chrono::steady_clock;
    static constexpr int kFramesInFlight = 4;

    struct Frame {
        std::array<GlQuery, kRenderPassCount> queries;
        std::array<bool, kRenderPassCount> used{};
        bool pending = false;
    };
    void fetch(Frame& frame);
    void endPass(FrameStats& stats);

    std::array<Frame, kFramesInFlight> frames_;
    int next_ = 0;                ///< The set of queries that the next frame takes: the oldest.
    Frame* measuring_ = nullptr;  ///< Null: this frame is not measured on the GPU.
    int pass_ = -1;
    Clock::time_point passStart_;
    PassTimes newest_;
};

}  // namespace lutka::render
