#include "editor/document/mend_profile.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lutka::editor {
namespace {

using physics::Finding;

bool sameFinding(const Finding& a, const Finding& b) {
    return a.code == b.code && a.place == b.place;
}

// What was asked to be mended, but is there still.
std::vector<Finding> stillThere(const physics::RagdollProfile& profile, const animation::Character& character,
                                const animation::HumanoidMap& map, std::span<const Finding> asked) {
    std::vector<Finding> left = physics::diagnose(profile, character, map).findings;
    std::erase_if(left, [&](const Finding& finding) {
        return std::none_of(asked.begin(), asked.end(), [&](const Finding& one) { return sameFinding(one, finding); });
    });
    return left;
}

// Whether one of the bodies is the other, or hangs on it.
bool linked(const physics::RagdollProfile& profile, const std::string& a, const std::string& b) {
    const int first = physics::bodyNamed(profile, a);
    const int second = physics::bodyNamed(profile, b);
    const auto hangs = [&](int child, int parent) {
        return child > 0 && profile.constraints[child - 1].parent == parent;
    };
    return a == b || (first >= 0 && second >= 0 && (hangs(first, second) || hangs(second, first)));
}

}  // namespace

std::vector<animation::Role> fixedToBlame(const DocumentState& state, std::span<const Finding> all,
                                          std::span<const Finding> asked) {
    std::vector<animation::Role> roles;
    const auto blame = [&](const std::string& name) {
        const int body = physics::bodyNamed(state.profile, name);
        for (const int one : {body, body > 0 ? state.profile.constraints[body - 1].parent : -1}) {
            const auto role = one >= 0 ? state.profile.bodies[one].role : std::nullopt;
            if (!role || !state.fixed[animation::indexOf(*role)]) continue;
            if (std::find(roles.begin(), roles.end(), *role) == roles.end()) roles.push_back(*role);
        }
    };
    for (const Finding& cause : all) {
        const bool isOfMap = cause.code == "joint-not-below" || cause.code == "limb-uneven";
        if (!isOfMap || cause.bodies.empty()) continue;
        const bool concerns = std::any_of(asked.begin(), asked.end(), [&](const Finding& finding) {
            return std::any_of(finding.bodies.begin(), finding.bodies.end(), [&](const std::string& body) {
                return linked(state.profile, body, cause.bodies.front());
            });
        });
        if (concerns) blame(cause.bodies.front());
    }
    return roles;
}

Result<physics::RagdollProfile> mendProfile(const physics::RagdollProfile& profile,
                                            const animation::Character& character, const animation::HumanoidMap& map,
                                            std::span<const Finding> findings, bool remapped) {
    constexpr int mostRounds = 8;
    std::vector<Finding> asked(findings.begin(), findings.end());
    if (!remapped) std::erase_if(asked, [](const Finding& finding) { return !finding.mendable; });
    std::vector<Finding> left = remapped ? stillThere(profile, character, map, asked) : asked;
    physics::RagdollProfile work = profile;
    for (int round = 0; round < mostRounds && !left.empty(); ++round) {
        if (std::none_of(left.begin(), left.end(), [](const Finding& one) { return one.mendable; })) break;
        auto mended = physics::applyMends(work, character, map, left);
        if (!mended) return mended;
        work = std::move(mended).value();
        left = stillThere(work, character, map, asked);
    }
    if (left.empty()) return work;
    return Error{ErrorCode::input,
                 fmt::format("{} of {} comes back however often it is mended", left.front().code, left.front().place),
                 "", "look at the mapping of its joints first"};
}

}  // namespace lutka::editor
