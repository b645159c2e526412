#pragma once

namespace lutka::editor {

/// How much a picture is worth while the machine is slow.
struct PictureQuality {
    float share = 1.0F;  ///< Of the window's width and height.
    bool ambientOcclusion = true;
};

/// Steps the picture's quality down while drawing takes too long, and up again when the better picture would be drawn
/// in time. A step that does not help, because something else is slow, is taken back: what the user does is taken in
/// order all the same, and is seen sooner.
class QualityGovernor {
  public:
    /// After a picture that took so long to draw, seconds. Returns what the next one is to be.
    const PictureQuality& update(double drawSeconds);
    [[nodiscard]] const PictureQuality& quality() const;

    static constexpr double kHelps = 0.85;     ///< What is left of a picture's time where a step down was worth it.
    static constexpr int kForgetFrames = 240;  ///< After which a step that did not help is tried again.
    static constexpr double kLateSeconds = 1.0 / 14.0;  ///< Of a picture; for kLateFrames in a row it steps down …
    static constexpr double kHaltSeconds = 0.2;         ///< … or after one such.
    static constexpr double kEasySeconds = 1.0 / 35.0;  ///< What the better picture may take to come back.
    static constexpr int kLateFrames = 4;
    static constexpr int kEasyFrames = 90;

  private:
    void takeBack();

    int level_ = 0;
    int lowest_ = kNoLimit;    // no level beyond helped
    int sinceLimit_ = 0;       // pictures
    double costBefore_ = 0.0;  // of a picture, before the last step down; 0: not known
    static constexpr int kNoLimit = 1000;
    int lateFor_ = 0;
    int easyFor_ = 0;
};

}  // namespace lutka::editor
