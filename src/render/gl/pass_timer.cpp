#include "render/gl/pass_timer.hpp"

#include "core/assert.hpp"

namespace lutka::render {

PassTimer::PassTimer() {
    for (Frame& frame : frames_) {
        for (GlQuery& query : frame.queries)
            query = GlQuery::create();
    }
}

// The last query of a frame ends last: when its result is there, all are.
void PassTimer::fetch(Frame& frame) {
    GLuint last = 0;
    for (std::size_t pass = 0; pass < kRenderPassCount; ++pass) {
        if (frame.used[pass]) last = frame.queries[pass].name();
    }
    GLint there = GL_FALSE;
    if (last != 0) glGetQueryObjectiv(last, GL_QUERY_RESULT_AVAILABLE, &there);
    if (there != GL_TRUE) return;
    constexpr double kMsPerNanosecond = 1e-6;
    newest_ = {};
    for (std::size_t pass = 0; pass < kRenderPassCount; ++pass) {
        if (!frame.used[pass]) continue;
        GLuint64 nanoseconds = 0;
        glGetQueryObjectui64v(frame.queries[pass].name(), GL_QUERY_RESULT, &nanoseconds);
        newest_.ms[pass] = static_cast<double>(nanoseconds) * kMsPerNanosecond;
    }
    newest_.known = true;
    frame.pending = false;
    frame.used = {};
}

void PassTimer::beginFrame(FrameStats& stats) {
    for (int i = 0; i < kFramesInFlight; ++i) {  // the oldest first, so that the newest stays
        Frame& frame = frames_[(next_ + i) % kFramesInFlight];
        if (frame.pending) fetch(frame);
    }
    stats.gpu = newest_;
    stats.cpu.known = true;
    measuring_ = frames_[next_].pending ? nullptr : &frames_[next_];
    pass_ = -1;
}

void PassTimer::endPass(FrameStats& stats) {
    if (pass_ < 0) return;
    if (measuring_ != nullptr) glEndQuery(GL_TIME_ELAPSED);
    const std::chrono::duration<double, std::milli> spent = Clock::now() - passStart_;
    stats.cpu.ms[pass_] = spent.count();
}

void PassTimer::begin(RenderPass pass, FrameStats& stats) {
    endPass(stats);
    pass_ = static_cast<int>(pass);
    passStart_ = Clock::now();
    if (measuring_ == nullptr) return;
    LUTKA_ASSERT(!measuring_->used[pass_]);
    measuring_->used[pass_] = true;
    glBeginQuery(GL_TIME_ELAPSED, measuring_->queries[pass_].name());
}

void PassTimer::endFrame(FrameStats& stats) {
    endPass(stats);
    pass_ = -1;
    if (measuring_ == nullptr) return;
    measuring_->pending = true;
    measuring_ = nullptr;
    next_ = (next_ + 1) % kFramesInFlight;
}

}  // namespace lutka::render
