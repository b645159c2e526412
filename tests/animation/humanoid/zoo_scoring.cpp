#include "zoo_scoring.hpp"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

namespace lutka::test {
namespace {

using animation::Role;

std::string trimmed(const std::string& text) {
    const auto first = text.find_first_not_of(" \t\n\r");
    if (first == std::string::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t\n\r") - first + 1);
}

std::vector<std::string> readNames(const nlohmann::json& list) {
    std::vector<std::string> names;
    for (const auto& name : list)
        names.push_back(name.is_string() ? trimmed(name.get<std::string>()) : std::string());
    return names;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

std::vector<Truth> readTruths(const std::filesystem::path& folder) {
    std::vector<Truth> truths;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        std::ifstream stream(entry.path() / "truth.json");
        if (!stream) continue;
        const nlohmann::json json = nlohmann::json::parse(stream);
        Truth truth;
        truth.model = entry.path().filename().string();
        truth.file = entry.path() / json.at("file").get<std::string>();
        truth.humanoid = json.at("humanoid") != false;
        if (truth.humanoid) {
            for (const auto& [name, accepted] : json.at("roles").items())
                truth.roles[indexOf(*animation::roleFromName(name))] = readNames(accepted);
            truth.spine = readNames(json.at("spine"));
            truth.chest = readNames(json.at("chest"));
        }
        truths.push_back(std::move(truth));
    }
    std::sort(truths.begin(), truths.end(), [](const Truth& a, const Truth& b) { return a.model < b.model; });
    return truths;
}

animation::Character readBones(const Truth& truth) {
    animation::Character character;
    animation::Skeleton& skeleton = character.skeleton;
    std::ifstream stream(truth.file.parent_path() / "bones.txt");
    std::string line;
    std::vector<int> ancestors;
    while (std::getline(stream, line)) {
        const auto place = line.find(" p=(");
        if (line.empty() || line.front() == '#' || place == std::string::npos) continue;
        const auto depth = line.find_first_not_of(' ');
        std::string name = line.substr(depth, place - depth);
        if (const auto mark = name.rfind(" [nb]"); mark != std::string::npos) name.resize(mark);
        RigidTransform frame;
        std::istringstream(line.substr(place + 4)) >> frame.translation.x >> frame.translation.y >> frame.translation.z;
        const auto vertices = line.find(" nv=");
        ancestors.resize(std::min(depth, ancestors.size()));
        skeleton.names.push_back(name);
        skeleton.parents.push_back(ancestors.empty() ? animation::kNoJoint : ancestors.back());
        skeleton.bindModelFromJoint.push_back(frame);
        skeleton.nodeParentFromJoint.emplace_back();
        skeleton.skinWeight.push_back(vertices == std::string::npos ? 0.0F : std::stof(line.substr(vertices + 4)));
        ancestors.push_back(skeleton.jointCount() - 1);
    }
    return character;
}

Score& Score::operator+=(const Score& other) {
    right += other.right;
    of += other.of;
    optionalRight += other.optionalRight;
    optionalOf += other.optionalOf;
    faults += other.faults;
    return *this;
}

Score scoreMap(const Truth& truth, const animation::HumanoidMap& map, const std::vector<std::string>& names) {
    Score score;
    if (!truth.humanoid) {
        score.of = 1;
        score.right = map.humanoid ? 0 : 1;
        if (map.humanoid) score.faults = "not refused";
        return score;
    }
    const auto nameOf = [&](Role role) {
        const int joint = map.jointOf(role);
        return joint == animation::kNoJoint ? std::string() : trimmed(names[joint]);
    };
    for (int index = 0; index < animation::kRoleCount; ++index) {
        const Role role = animation::roleAt(index);
        const bool trunk = role == Role::spine || role == Role::chest || role == Role::upperChest;
        if (!truth.roles[index] || trunk) continue;
        const std::vector<std::string>& accepted = *truth.roles[index];
        const bool required = animation::isRequired(role);
        if (required && accepted == std::vector<std::string>{""}) continue;
        const bool good = contains(accepted, nameOf(role));
        (required ? score.of : score.optionalOf) += 1;
        (required ? score.right : score.optionalRight) += good ? 1 : 0;
        if (!good) score.faults += std::string(roleName(role)) + "=" + nameOf(role) + " (" + accepted[0] + ") ";
    }
    if (truth.chest.empty() && truth.spine.empty()) return score;
    std::vector<std::string> trunk;
    for (const Role role : {Role::upperChest, Role::chest, Role::spine}) {
        if (map[role]) trunk.push_back(nameOf(role));
    }
    std::vector<std::string> low = truth.spine;
    low.insert(low.end(), truth.chest.begin(), truth.chest.end());
    bool good = !trunk.empty() && contains(truth.chest.empty() ? low : truth.chest, trunk[0]);
    for (std::size_t i = 1; i < trunk.size(); ++i)
        good = good && contains(low, trunk[i]);
    score.of += 1;
    score.right += good ? 1 : 0;
    if (!good) {
        score.faults += "trunk=";
        for (const std::string& name : trunk)
            score.faults += name + ",";
    }
    if (!map.humanoid) score.faults = "REFUSED " + (map.warnings.empty() ? "" : map.warnings.front());
    return score;
}

Truth mirrorTruth(Truth truth) {
    for (int index = 0; index < animation::kRoleCount; ++index) {
        const Role role = animation::roleAt(index);
        if (animation::sideOf(role) == animation::Side::left) {
            std::swap(truth.roles[index], truth.roles[indexOf(animation::mirrored(role))]);
        }
    }
    return truth;
}

}  // namespace lutka::test
