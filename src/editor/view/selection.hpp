#pragma once

#include <algorithm>
#include <optional>
#include <vector>

namespace lutka::editor {

/// One selected thing: a body of a doll, or an object of the scene.
struct Item {
    enum class Kind { body, object };
    Kind kind = Kind::body;
    int doll = 0;   ///< Body: which doll.
    int index = 0;  ///< Body of the profile, or the id of an entity.

    friend bool operator==(const Item&, const Item&) = default;
};

/// What is selected; the last one picked is the active one, which panels show.
class Selection {
  public:
    [[nodiscard]] bool empty() const { return items_.empty(); }
    [[nodiscard]] const std::vector<Item>& items() const { return items_; }
    [[nodiscard]] std::optional<Item> active() const {
        return items_.empty() ? std::nullopt : std::optional(items_.back());
    }
    [[nodiscard]] bool contains(const Item& item) const {
        return std::find(items_.begin(), items_.end(), item) != items_.end();
    }

    void clear() { items_.clear(); }
    void set(const Item& item) { items_.assign(1, item); }
    /// Adds the item as the active one; takes it away when it is active already.
    void toggle(const Item& item) {
        const bool wasActive = active() == item;
        std::erase(items_, item);
        if (!wasActive) items_.push_back(item);
    }
    /// Drops what is no longer there.
    template <class StillThere>
    void keepIf(const StillThere& stillThere) {
        std::erase_if(items_, [&](const Item& item) { return !stillThere(item); });
    }

  private:
    std::vector<Item> items_;
};

}  // namespace lutka::editor
