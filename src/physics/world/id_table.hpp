#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lutka::physics {

/// Gives out the ids of one kind, and maps each to its place: an index into a solver's own arrays, which hold what is
/// left in the order of adding. A place goes down when something before it is removed.
template <class IdType>
class IdTable {
  public:
    /// The id of something new, whose place is the last.
    IdType add() {
        if (free_.empty()) {
            free_.push_back(static_cast<int>(slots_.size()));
            slots_.emplace_back();
        }
        const int index = free_.back();
        free_.pop_back();
        Slot& slot = slots_[index];
        slot.place = static_cast<int>(ids_.size());
        ++slot.generation;
        ids_.push_back({index, slot.generation});
        return ids_.back();
    }

    /// `id` must be in the table.
    void remove(IdType id) {
        const int place = slots_[id.index].place;
        slots_[id.index].place = -1;
        free_.push_back(id.index);
        ids_.erase(ids_.begin() + place);
        for (std::size_t i = place; i < ids_.size(); ++i)
            --slots_[ids_[i].index].place;
    }

    /// -1 for an id of nothing, of something removed, or of no world.
    [[nodiscard]] int placeOf(IdType id) const {
        if (id.index < 0 || id.index >= static_cast<int>(slots_.size())) return -1;
        const Slot& slot = slots_[id.index];
        return slot.generation == id.generation ? slot.place : -1;
    }

    /// In the order of adding.
    [[nodiscard]] std::span<const IdType> ids() const { return ids_; }
    [[nodiscard]] int count() const { return static_cast<int>(ids_.size()); }

  private:
    struct Slot {
        int place = -1;  // -1: free
        std::uint32_t generation = 0;
    };
    std::vector<Slot> slots_;
    std::vector<int> free_;  // slots
    std::vector<IdType> ids_;
};

}  // namespace lutka::physics
