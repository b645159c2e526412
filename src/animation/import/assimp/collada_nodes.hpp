#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "animation/import/assimp/collada_tags.hpp"

namespace lutka::animation::rig_import {

/// A step of a node's transform: <translate>, <rotate>, <scale>, <matrix>, <lookat>.
struct ColladaTransform {
    std::string_view kind;
    std::string_view sid;
    std::size_t tag = 0;
    std::string ownSid;  ///< As Assimp can take it: sids with dots and brackets get another.
};

struct ColladaNode {
    std::size_t tag = 0;
    std::size_t end = 0;  ///< One past the last node below it.
    std::string_view id;
    std::string_view sid;
    std::string_view name;
    std::string ownId;  ///< As Assimp can take it: nodes without an id, and ids with dots, slashes and blanks, get one.
    std::vector<ColladaTransform> transforms;
};

/// The nodes of a tidied document (tidyCollada()), parents before children. Points into the text of its tags.
class ColladaNodes {
  public:
    explicit ColladaNodes(const std::vector<ColladaTag>& tags);

    [[nodiscard]] const std::vector<ColladaNode>& all() const { return nodes_; }
    [[nodiscard]] std::optional<std::size_t> withId(std::string_view id) const;
    /// The first node with that sid that is one of `roots` or below one; of all nodes where there are no roots.
    [[nodiscard]] std::optional<std::size_t> withSid(std::string_view sid, std::span<const std::size_t> roots) const;
    [[nodiscard]] std::optional<std::size_t> withName(std::string_view name) const;

  private:
    using Index = std::unordered_map<std::string_view, std::vector<std::size_t>>;  // nodes in ascending order

    void giveOwnIds(const std::vector<ColladaTag>& tags);

    std::vector<ColladaNode> nodes_;
    Index byId_;
    Index bySid_;
    Index byName_;
};

/// A document in which Assimp 5.2.5 finds the nodes that are meant.
struct SettledCollada {
    std::string text;
    std::map<std::string, std::string> names;  ///< What nodes are called whose ids were made up here.
    std::vector<std::string> warnings;
};

/// Settles who is meant in a tidied document (tidyCollada()) with ids of its own (withOwnIds()): Assimp finds the
/// joints of a skin by name in the whole document, however many skeletons have joints of that name, and drops channels
/// whose targets it does not understand in silence. Each node has an id, each skin names its joints by them and has a
/// copy for each skeleton that it is shown with, and the target of each channel is an id and a sid, with a member where
/// it has one. What channels can't reach is told.
[[nodiscard]] SettledCollada settledCollada(const std::string& text);

}  // namespace lutka::animation::rig_import
