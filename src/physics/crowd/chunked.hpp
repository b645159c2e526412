#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

namespace lutka::physics::crowd {

/// A long list that grows and shrinks from step to step, kept in pieces of one size. A vector of many megabytes that
/// grows leaves a hole in the heap each time, which the next, larger one does not fit into.
template <class T, std::size_t kChunk>
class Chunked {
  public:
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] T& operator[](std::size_t i) { return chunks_[i / kChunk][i % kChunk]; }
    [[nodiscard]] const T& operator[](std::size_t i) const { return chunks_[i / kChunk][i % kChunk]; }

    void push_back(const T& item) {
        resize(size_ + 1);
        (*this)[size_ - 1] = item;
    }
    /// New items are of no certain value.
    void resize(std::size_t count) {
        while (chunks_.size() * kChunk < count)
            chunks_.push_back(std::make_unique<T[]>(kChunk));
        size_ = count;
    }
    /// Keeps room for about as many.
    void clear() {
        const std::size_t used = (size_ + kChunk - 1) / kChunk;
        chunks_.resize(std::min(chunks_.size(), used + used / 4 + 1));
        size_ = 0;
    }
    template <class Removes>
    void removeIf(const Removes& removes) {
        std::size_t to = 0;
        for (std::size_t i = 0; i < size_; ++i)
            if (!removes((*this)[i])) (*this)[to++] = (*this)[i];
        size_ = to;
    }

    class Iterator {
      public:
        Iterator(const Chunked& list, std::size_t at) : list_(list), at_(at) {}
        [[nodiscard]] const T& operator*() const { return list_[at_]; }
        Iterator& operator++() {
            ++at_;
            return *this;
        }
        [[nodiscard]] bool operator!=(const Iterator& other) const { return at_ != other.at_; }

      private:
        const Chunked& list_;
        std::size_t at_;
    };
    [[nodiscard]] Iterator begin() const { return {*this, 0}; }
    [[nodiscard]] Iterator end() const { return {*this, size_}; }

  private:
    std::vector<std::unique_ptr<T[]>> chunks_;
    std::size_t size_ = 0;
};

}  // namespace lutka::physics::crowd
