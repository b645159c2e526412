#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/rigid_transform.hpp"

namespace lutka::exporting {

/// What makes a file unusable; thrown and caught within the reader.
struct Unusable {
    std::string why;
};

// Members of foreign JSON: what is missing or of another type is nothing.
[[nodiscard]] const nlohmann::json* memberOf(const nlohmann::json& object, const char* key);
[[nodiscard]] const nlohmann::json* itemOf(const nlohmann::json& object, const char* array, std::optional<int> index);
[[nodiscard]] std::optional<int> indexIn(const nlohmann::json& object, const char* key);
/// Finite.
[[nodiscard]] std::optional<float> numberIn(const nlohmann::json& object, const char* key);
/// Finite, exactly `count` of them; empty otherwise.
[[nodiscard]] std::vector<float> numbersIn(const nlohmann::json& object, const char* key, std::size_t count);

/// The nodes of a glTF document in the pose that the file states, with every scale taken out of the frames.
class GltfScene {
  public:
    struct Node {
        int parent = -1;
        RigidTransform sceneFromNode;
        float scale = 1.0F;  ///< Metres a unit of the node; the mean of its axes.
        std::string name;
        std::string step;  ///< Of paths: the name, with "#2", "#3" … where siblings before it share it.
    };

    /// Throws Unusable where nodes do not make a tree. Keeps the document, which must outlive it.
    explicit GltfScene(const nlohmann::json& document);

    [[nodiscard]] std::size_t size() const { return nodes_.size(); }
    [[nodiscard]] const Node& operator[](std::size_t index) const { return nodes_[index]; }
    /// As jointPath(), from the file's root node.
    [[nodiscard]] std::string pathOf(std::size_t node) const;
    /// The node's extension of that name; nothing where it has none.
    [[nodiscard]] const nlohmann::json* extension(std::size_t node, const char* name) const;

  private:
    void place(std::size_t index, int depth);
    void setParents();

    const nlohmann::json& document_;
    std::vector<Node> nodes_;
    std::vector<bool> placed_;
};

}  // namespace lutka::exporting
