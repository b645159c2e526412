#include "animation/wide/groups.hpp"

#include <new>

namespace lutka::animation::wide {
namespace {

constexpr std::align_val_t kAlignment{64};
// More pieces than threads, so that one slow thread holds up little.
constexpr std::size_t kPiecesAThread = 4;

}  // namespace

void Scratch::Free::operator()(float* memory) const {
    ::operator delete(memory, kAlignment);
}

Scratch::Scratch(const TaskPool& pool, std::size_t floats)
    : pieces_(pool.threads() == 1 ? 1 : static_cast<std::size_t>(pool.threads()) * kPiecesAThread),
      stride_((floats + 15) / 16 * 16),
      memory_(static_cast<float*>(::operator new(pieces_* stride_ * sizeof(float), kAlignment))) {}

}  // namespace lutka::animation::wide
