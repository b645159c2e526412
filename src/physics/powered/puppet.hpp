#pragma once

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "physics/powered/body_pin.hpp"
#include "physics/powered/pose_drive.hpp"

namespace lutka::physics {

/// What a puppet is doing.
enum class PuppetState {
    animated,   ///< Follows its pose with all its strength.
    reacting,   ///< Was hit: follows, some joints weaker than they were.
    limp,       ///< Knocked out: a passive doll.
    gettingUp,  ///< Comes back to its pose: its strength grows, and it is on its way to stand.
};
[[nodiscard]] std::string_view puppetStateName(PuppetState state);

struct PuppetSettings {
    MuscleSettings muscles;
    float pinForceN = 3000.0F;  ///< Holds the root body to its pose with at most so much, >= 0; 0: it stands or falls.
    std::vector<float> pins;    ///< The same of other bodies, N, one a body (the root's means nothing); empty: none.
    /// With what weight each body is led to its pose itself, [0, 1], one a body; see BodyTarget. 1: kinematic; 0: by
    /// the muscles alone. Empty: all 0. A pinned body that is led has no pin. None is led while the puppet is limp.
    std::vector<float> led;
    bool balances = true;      ///< A doll that stands and of which no body is pinned or led keeps its balance.
    float gravity = 9.81F;     ///< m/s² down, > 0: what it balances against.
    float leadSpeed = 1.5F;    ///< m/s, > 0: while a weight grows no body is drawn to its pose faster than this,
    float leadTurn = 3.5F;     ///< nor turned, rad/s, > 0; only one that is near becomes kinematic.
    float leadSeconds = 0.5F;  ///< A weight grows by 1 in so long, >= 0; one that falls does so at once, and the body
                               ///< goes on as it moves.
    float hitSpeed = 2.0F;     ///< m/s, > 0: a hit that changes a body's speed by this leaves it 1/e of its strength.
    float falloff = 0.4F;      ///< [0, 1]: what of a body's loss its neighbour along the tree has.
    float recoverySeconds = 0.4F;  ///< After which a joint has its strength back, along 3t² - 2t³; >= 0.
    float knockOutLoss = 0.75F;    ///< Mean loss of all joints, weighed by the mass that they move, above which it goes
                                   ///< limp; 1 and more: never.
    float knockOutTilt = radians(50.0F);  ///< Of the root body from its pose, radians, above which it goes limp.
    float getUpForceN = 3000.0F;          ///< In place of `pinForceN` while it gets up, >= 0.
    float getUpLead = radians(15.0F);     ///< While it gets up no joint is drawn to more than this ahead of where it
                                          ///< is: what was held by the floor does not snap back; radians, > 0.
    float getUpSpeed = radians(450.0F);   ///< Nor driven faster than this, rad/s, > 0.
};

/// A doll that follows a pose in motion with its muscles, reacts to hits and goes limp when one is too much. The world
/// must outlive it.
class Puppet {
  public:
    /// `root`: the body that is pinned. `bodies` as for PoseDrive. The profile must outlive the puppet.
    Puppet(World& world, DollId doll, const RagdollProfile& profile, int root, std::span<const BodyState> bodies,
           const PuppetSettings& settings);

    /// Call before each step of the world: the pose moves from `from` to `to` (world, one frame a body) in its `dt` > 0
    /// seconds. Limp puppets do not follow. Allocates nothing once the doll has motors.
    void prepare(std::span<const RigidTransform> from, std::span<const RigidTransform> to, float dt);

    /// An impulse in N s at a world point of a body: it acts, and the strength of that joint and, less, of its
    /// neighbours is lost for a while. Hits add up.
    void hit(int body, const vec3& point, const vec3& impulse);
    /// The loss of strength of hit() alone, for an impulse, N s >= 0, that the world has applied itself: something flew
    /// against the body.
    void feel(int body, float impulse);
    /// Knocks it out.
    void goLimp();
    /// From limp: comes back to its pose, its strength grows over `seconds` > 0. Call it when the pose is near to where
    /// the doll is. Ended early by goLimp() and by hits that are too much.
    void comeBack(float seconds);
    /// The same for a way to its feet: it is gettingUp until stand() is called.
    void getUp(float seconds);
    void stand();
    /// In the coming step a body is held where it is with at most so much, N, while it gets up: its pin carries the
    /// doll then, so that a foot has too little weight on it to stay where it stands.
    void hold(int body, const RigidTransform& worldFromBody, float forceN);
    /// Led bodies may be away from their pose: they are drawn to it, at leadSpeed and leadTurn at most.
    void approach();

    [[nodiscard]] PuppetState state() const { return state_; }
    /// What is left of the strength of the joint above a body (of the pin: of the root), [0, 1].
    [[nodiscard]] float strengthLeft(int body) const;
    /// Called at each change of state, from within the call that brings it about.
    void onChange(std::function<void(PuppetState before, PuppetState after)> listener) {
        listener_ = std::move(listener);
    }
    /// With what weight a body is led now, [0, 1].
    [[nodiscard]] float weightOf(int body) const { return weights_[body]; }
    /// To be changed at any time.
    [[nodiscard]] PuppetSettings& settings() { return settings_; }
    [[nodiscard]] DollId doll() const { return doll_; }
    /// Says which of left and right foot are on the ground: nobody balances in the air. Call it before prepare().
    void setGrounded(const std::array<bool, 2>& feet) { grounded_ = feet; }
    /// The bodies of left and right foot; -1: none.
    [[nodiscard]] std::array<int, 2> feet() const { return balance_.feet(); }

  private:
    struct Loss {
        float amount = 0.0F;   // of the strength, when it was hit last
        float seconds = 0.0F;  // since then
    };
    // Where a body is held in the coming step; with no force it is not.
    struct Hold {
        RigidTransform worldFromBody;
        float forceN = 0.0F;
    };
    void change(PuppetState state);
    [[nodiscard]] float lossOf(int body) const;
    void beginReturn(float seconds, bool standsByItself);
    void recover(float dt);
    void lead(std::span<const RigidTransform> from, std::span<const RigidTransform> to, float dt);
    void draw(int body, BodyTarget& target);
    void pull(std::span<const RigidTransform> from, std::span<const RigidTransform> to, float dt);
    [[nodiscard]] float reachOf(const RigidTransform& pose) const;
    [[nodiscard]] bool isHeld() const;
    void letGo();
    [[nodiscard]] bool isTooMuch(std::span<const RigidTransform> pose);

    World& world_;
    DollId doll_;
    const RagdollProfile& profile_;
    int root_;
    PuppetSettings settings_;
    PoseDrive drive_;
    Balance balance_;
    std::array<bool, 2> grounded_{false, false};
    std::vector<std::unique_ptr<BodyPin>> pins_;  // one a body, null where nothing pulls
    std::vector<Hold> holds_;                     // one a body
    std::vector<float> weights_;                  // one a body: with which it is led now
    PuppetState state_ = PuppetState::animated;
    std::vector<bool> isThere_;               // likewise: whether it has come to its pose since its weight grew
    std::vector<Loss> losses_;                // one a body
    std::vector<std::vector<int>> distance_;  // between bodies, in joints
    std::vector<float> factors_;              // one a body: what is left of its strength
    std::vector<BodyState> bodies_;           // scratch
    float back_ = 1.0F;                       // how much of its strength it has while it returns
    float backSeconds_ = 1.0F;
    bool failedToRise_ = false;   // it went limp on its last way up
    bool isLeashed_ = false;      // to getUpLead and getUpSpeed
    bool standsByItself_ = true;  // gettingUp ends when its strength is back
    std::function<void(PuppetState, PuppetState)> listener_;
};

}  // namespace lutka::physics
