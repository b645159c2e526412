#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace lutka {

/// Disjoint sets of [0, count); the representative is the smallest member, so that it does not depend on the order of
/// joining.
class UnionFind {
  public:
    /// Every one of [0, count) a set of its own.
    void reset(std::size_t count) {
        parent_.resize(count);
        std::iota(parent_.begin(), parent_.end(), 0);
    }

    int find(int item) {
        while (parent_[item] != item)
            item = parent_[item] = parent_[parent_[item]];
        return item;
    }
    void join(int a, int b) {
        a = find(a);
        b = find(b);
        if (a != b) parent_[std::max(a, b)] = std::min(a, b);
    }

  private:
    std::vector<int> parent_;
};

}  // namespace lutka
