#pragma once

namespace lutka {

/// While it lives, what this process prints to standard output goes to standard error: for code of third parties that
/// prints, in a program whose output that is. The whole process is meant: not where other threads print, or do this, at
/// the same time. What can't be taken by standard error is lost, and is no failure of standard output. Without the
/// handles for it nothing changes.
class StdoutAside {
  public:
    StdoutAside();
    ~StdoutAside();
    StdoutAside(const StdoutAside&) = delete;
    StdoutAside& operator=(const StdoutAside&) = delete;

  private:
    int kept_ = -1;  ///< What standard output was.
};

}  // namespace lutka
