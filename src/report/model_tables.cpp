#include "report/model_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/markup_text.hpp"
#include "report/html_text.hpp"

namespace lutka::reporting {
namespace {

using physics::Severity;

constexpr float kGoodScore = 85.0F;
constexpr float kFairScore = 60.0F;
constexpr float kNeverSettled = 99.0F;  // what the checkup gives a drop that never came to rest

std::ptrdiff_t countOf(const physics::Diagnosis& diagnosis, Severity severity) {
    return std::count_if(diagnosis.findings.begin(), diagnosis.findings.end(),
                         [&](const physics::Finding& finding) { return finding.severity == severity; });
}

std::string plural(std::ptrdiff_t count, std::string_view word) {
    return fmt::format("{} {}{}", count, word, count == 1 ? "" : "s");
}

// A bar as wide as the share, [0, 1].
std::string bar(float share, std::string_view kind) {
    return fmt::format("<span class=\"bar {}\"><i style=\"width:{:.1f}%\"></i></span>", kind,
                       100.0F * std::clamp(share, 0.0F, 1.0F));
}

std::string fact(std::string_view term, const std::string& value) {
    return fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", term, value);
}

std::string primitiveText(const physics::PrimitiveShape& shape) {
    switch (shape.kind) {
        case physics::PrimitiveShape::Kind::capsule:
            return fmt::format("capsule, radius {:.1f}, length {:.1f}", shape.radius * 100,
                               (shape.halfLength + shape.radius) * 200);
        case physics::PrimitiveShape::Kind::sphere:
            return fmt::format("sphere, radius {:.1f}", shape.radius * 100);
        case physics::PrimitiveShape::Kind::hull: {
            const vec3 size = 100.0F * (shape.hull->high() - shape.hull->low());
            return fmt::format("hull of {} corners, {:.1f} × {:.1f} × {:.1f}", shape.hull->points().size(), size.x,
                               size.y, size.z);
        }
        case physics::PrimitiveShape::Kind::box:
            break;
    }
    return fmt::format("box {:.1f} × {:.1f} × {:.1f}", shape.halfExtents.x * 200, shape.halfExtents.y * 200,
                       shape.halfExtents.z * 200);
}

std::string shapeText(const physics::BodyShape& shape) {
    std::string text = primitiveText(shape);
    for (const physics::AddedShape& added : shape.more)
        text += "<br>" + primitiveText(added);
    return text;
}

std::string limitText(const physics::ConstraintProfile& constraint) {
    if (constraint.kind == physics::ConstraintProfile::Kind::hinge) {
        return fmt::format("hinge, {:.0f}° to {:.0f}°", degrees(constraint.hinge.lower),
                           degrees(constraint.hinge.upper));
    }
    return fmt::format("cone, swing {:.0f}° and {:.0f}°, twist {:.0f}°", degrees(constraint.cone.swingY),
                       degrees(constraint.cone.swingZ), degrees(constraint.cone.twist));
}

std::string rolesTable(const animation::HumanoidMap& map, const animation::Skeleton& skeleton) {
    std::string out =
        "<table><thead><tr><th>Role</th><th>Joint</th><th class=\"number\">Sure</th><th>Why</th></tr></thead><tbody>\n";
    for (int index = 0; index < animation::kRoleCount; ++index) {
        const auto role = animation::roleAt(index);
        const auto& binding = map.roles[index];
        if (binding) {
            out += fmt::format(
                "<tr><td>{}</td><td><code>{}</code></td><td class=\"number\">{:.0f} %</td><td>{}</td></tr>\n",
                animation::roleName(role), markupEscaped(skeleton.names[binding->joint]), binding->confidence * 100.0F,
                markupEscaped(binding->reason));
        } else if (animation::isRequired(role)) {
            out +=
                fmt::format("<tr class=\"lacking\"><td>{}</td><td>–</td><td></td><td>required, not found</td></tr>\n",
                            animation::roleName(role));
        }
    }
    return out + "</tbody></table>\n";
}

}  // namespace

std::string verdictOf(const scene::Checkup& checkup) {
    const std::ptrdiff_t errors = countOf(checkup.diagnosis, Severity::error);
    const std::ptrdiff_t warnings = countOf(checkup.diagnosis, Severity::warning);
    if (errors > 0) return "Not sound: " + plural(errors, "error");
    if (warnings > 0) return "Sound, with " + plural(warnings, "warning");
    return "Sound";
}

const char* scoreClass(float score) {
    return score >= kGoodScore ? "good" : score >= kFairScore ? "fair" : "poor";
}

std::string scoreRing(float score) {
    constexpr float kRadius = 52;
    const float around = 2 * std::numbers::pi_v<float> * kRadius;
    return fmt::format(
        "<svg class=\"ring {0}\" viewBox=\"0 0 128 128\" role=\"img\" aria-label=\"Score {1:.0f} of 100\">"
        "<circle class=\"ringBack\" cx=\"64\" cy=\"64\" r=\"{2:g}\"/>"
        "<circle class=\"ringFront\" cx=\"64\" cy=\"64\" r=\"{2:g}\" stroke-dasharray=\"{3:.1f} {4:.1f}\" "
        "transform=\"rotate(-90 64 64)\"/>"
        "<text class=\"ringScore\" x=\"64\" y=\"71\" text-anchor=\"middle\">{1:.0f}</text>"
        "<text class=\"ringOf\" x=\"64\" y=\"88\" text-anchor=\"middle\">of 100</text></svg>",
        scoreClass(score), score, kRadius, around * std::clamp(score, 0.0F, 100.0F) / 100.0F, around);
}

std::string scorePartsHtml(const scene::Checkup& checkup) {
    std::string out = "<ul class=\"parts\">\n";
    for (const physics::ScorePart& part : checkup.diagnosis.parts) {
        const float share = part.of > 0.0F ? part.points / part.of : 0.0F;
        out += fmt::format("<li><span>{}</span>{}<b>{:.0f}<small> / {:.0f}</small></b></li>\n",
                           markupEscaped(part.name), bar(share, scoreClass(share * 100.0F)), part.points, part.of);
    }
    const auto kept = std::count_if(checkup.bounds.begin(), checkup.bounds.end(),
                                    [](const scene::MeasuredBound& bound) { return bound.worst <= bound.bound; });
    if (!checkup.bounds.empty()) {
        const float share = static_cast<float>(kept) / static_cast<float>(checkup.bounds.size());
        out += fmt::format("<li><span>bounds kept in three drops</span>{}<b>{}<small> / {}</small></b></li>\n",
                           bar(share, scoreClass(share * 100.0F)), kept, checkup.bounds.size());
    }
    return out + "</ul>\n";
}

std::string factsHtml(const scene::RagdollAsset& asset, const scene::Checkup& checkup) {
    const physics::RagdollProfile& profile = asset.profile;
    std::string out = "<dl class=\"facts\">\n";
    out += fact("Height", fmt::format("{:.2f} m", profile.heightM));
    out += fact("Mass", fmt::format("{:.1f} kg", profile.totalMassKg));
    out += fact("Bodies", fmt::format("{}", profile.bodies.size()));
    out += fact("Joints of the rig", fmt::format("{}", asset.character.skeleton.jointCount()));
    if (asset.map.humanoid) out += fact("Mapping", fmt::format("{:.0f} % sure", asset.map.confidence * 100.0F));
    const physics::FitMeasures& fit = checkup.diagnosis.fit;
    if (fit.vertices > 0) {
        out += fact("Skin near its body", fmt::format("{:.0f} % of {}", fit.skinNear * 100, fit.vertices));
        if (fit.volumeCovered) out += fact("Volume covered", fmt::format("{:.0f} %", *fit.volumeCovered * 100));
        out += fact("Deepest overlap", fmt::format("{:.1f} mm", fit.overlapM * 1e3F));
    }
    return out + "</dl>\n";
}

std::string boundsTable(const scene::Checkup& checkup) {
    if (checkup.bounds.empty())
        return "<p class=\"empty\">It was not dropped: a ragdoll with errors is not simulated.</p>\n";
    std::string out =
        "<table><thead><tr><th>Measured</th><th class=\"number\">Worst of three</th><th class=\"number\">Allowed</th>"
        "<th></th></tr></thead><tbody>\n";
    for (const scene::MeasuredBound& bound : checkup.bounds) {
        const bool kept = bound.worst <= bound.bound;
        const std::string worst = bound.worst >= kNeverSettled && bound.unit == "s"
                                      ? "never"
                                      : fmt::format("{:.2f} {}", bound.worst, markupEscaped(bound.unit));
        out += fmt::format(
            "<tr><td>{}</td><td class=\"number\">{}</td><td class=\"number\">{:g} {}</td>"
            "<td><span class=\"badge {}\">{}</span></td></tr>\n",
            markupEscaped(bound.name), worst, bound.bound, markupEscaped(bound.unit), kept ? "good" : "poor",
            kept ? "kept" : "broken");
    }
    return out + "</tbody></table>\n";
}

std::string findingsHtml(const physics::Diagnosis& diagnosis) {
    if (diagnosis.findings.empty()) return "<p class=\"empty\">Nothing was found.</p>\n";
    std::string out = "<ul class=\"findings\">\n";
    for (const physics::Finding& finding : diagnosis.findings) {
        const char* severity = physics::severityName(finding.severity);
        out += fmt::format("<li class=\"{0}\"><span class=\"badge {0}\">{0}</span><div><p><b>{1}</b>{2}: {3}</p>",
                           severity, markupEscaped(finding.code),
                           finding.place.empty() ? "" : " at " + markupEscaped(finding.place),
                           markupEscaped(finding.measure));
        if (!finding.mend.empty()) {
            out += fmt::format("<p class=\"mend\">{}{}</p>", htmlOfMessage(finding.mend),
                               finding.mendable ? " <code>lutka check --fix</code> does it." : "");
        }
        out += "</div></li>\n";
    }
    return out + "</ul>\n";
}

std::string mappingTable(const scene::RagdollAsset& asset) {
    if (asset.map.humanoid) return rolesTable(asset.map, asset.character.skeleton);
    std::string out =
        "<p>This ragdoll was made of the skeleton as it is, without the parts of a human.</p>\n"
        "<table><thead><tr><th>Body</th><th>Joint</th><th>Path</th></tr></thead><tbody>\n";
    for (const physics::BodyProfile& body : asset.profile.bodies) {
        out += fmt::format("<tr><td>{}</td><td><code>{}</code></td><td><code>{}</code></td></tr>\n",
                           markupEscaped(body.name), markupEscaped(body.joint), markupEscaped(body.jointPath));
    }
    return out + "</tbody></table>\n";
}

std::string bodiesTable(const physics::RagdollProfile& profile) {
    float heaviest = 1e-6F;
    for (const physics::BodyProfile& body : profile.bodies)
        heaviest = std::max(heaviest, body.massKg);
    std::string out =
        "<table><thead><tr><th>Body</th><th>Hangs on</th><th class=\"number\">Mass</th><th></th><th>Shape (cm)</th>"
        "<th>Limits</th><th class=\"number\">Friction</th></tr></thead><tbody>\n";
    for (std::size_t i = 0; i < profile.bodies.size(); ++i) {
        const physics::BodyProfile& body = profile.bodies[i];
        const physics::ConstraintProfile* joint = i > 0 ? &profile.constraints[i - 1] : nullptr;
        out += fmt::format(
            "<tr><td>{}</td><td>{}</td><td class=\"number\">{:.2f} kg</td><td>{}</td><td>{}</td><td>{}</td>"
            "<td class=\"number\">{}</td></tr>\n",
            markupEscaped(body.name), joint == nullptr ? "–" : markupEscaped(profile.bodies[joint->parent].name),
            body.massKg, bar(body.massKg / heaviest, "plain"), shapeText(body.shape),
            joint == nullptr ? "–" : limitText(*joint),
            joint == nullptr ? "–" : fmt::format("{:.2g} N m", joint->frictionNm));
    }
    return out + "</tbody></table>\n";
}

std::string notesHtml(const scene::RagdollAsset& asset) {
    std::vector<std::string> notes = asset.character.warnings;
    notes.insert(notes.end(), asset.map.warnings.begin(), asset.map.warnings.end());
    if (asset.fromModel) notes.emplace_back("The ragdoll is the file's own; --refit fits a new one.");
    if (asset.rebound) notes.emplace_back("The profile was made for another rig and is bound by role.");
    if (notes.empty()) return "";
    std::string out = "<ul class=\"notes\">\n";
    for (const std::string& note : notes)
        out += fmt::format("<li>{}</li>\n", htmlOfMessage(note));
    return out + "</ul>\n";
}

}  // namespace lutka::reporting
