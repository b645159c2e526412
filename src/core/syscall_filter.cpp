#include "core/syscall_filter.hpp"

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/syscall.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace lutka {
namespace {

#if defined(__x86_64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_AARCH64;
#else
constexpr std::uint32_t kArchitecture = 0;
#endif

constexpr std::uint32_t kRefuse = SECCOMP_RET_ERRNO | EPERM;
constexpr std::uint32_t kUnknown = SECCOMP_RET_ERRNO | ENOSYS;
// Opening for anything but reading.
constexpr std::uint32_t kWriting = O_WRONLY | O_RDWR | O_CREAT | O_TRUNC | O_APPEND;

// Calls that change something outside of the process. Only some architectures have the older ones of each kind.
constexpr int kForbidden[] = {
#ifdef SYS_creat
    SYS_creat,
    SYS_fork,
    SYS_vfork,
    SYS_rename,
    SYS_mkdir,
    SYS_rmdir,
    SYS_link,
    SYS_symlink,
    SYS_unlink,
    SYS_mknod,
    SYS_chmod,
    SYS_chown,
    SYS_lchown,
    SYS_utime,
    SYS_utimes,
    SYS_futimesat,
#endif
    SYS_execve,
    SYS_execveat,
    SYS_socket,
    SYS_socketpair,
    SYS_connect,
    SYS_bind,
    SYS_renameat,
    SYS_renameat2,
    SYS_mkdirat,
    SYS_linkat,
    SYS_symlinkat,
    SYS_unlinkat,
    SYS_mknodat,
    SYS_fchmod,
    SYS_fchmodat,
    SYS_fchown,
    SYS_fchownat,
    SYS_utimensat,
    SYS_truncate,
    SYS_ftruncate,
    SYS_fallocate,
    SYS_setxattr,
    SYS_lsetxattr,
    SYS_fsetxattr,
    SYS_removexattr,
    SYS_lremovexattr,
    SYS_fremovexattr,
    SYS_mount,
    SYS_umount2,
    SYS_chroot,
    SYS_pivot_root,
    SYS_ptrace,
    SYS_process_vm_readv,
    SYS_process_vm_writev,
    SYS_kill,
    SYS_tkill,
    SYS_setrlimit,
    SYS_prlimit64,
    SYS_bpf,
    SYS_perf_event_open,
    SYS_keyctl,
    SYS_add_key,
    SYS_request_key,
    SYS_unshare,
    SYS_setns,
    SYS_userfaultfd,
    SYS_io_uring_setup,
};

/// A program for the kernel's filter: a list of tests of the call, the last of which lets it pass.
class Filter {
  public:
    Filter() {
        load(offsetof(seccomp_data, arch));
        unless(BPF_JEQ, kArchitecture, kUnknown);
        load(offsetof(seccomp_data, nr));
#ifdef __X32_SYSCALL_BIT
        when(BPF_JGE, __X32_SYSCALL_BIT, kUnknown);  // another door to the same calls
#endif
    }

    void refuse(int call, std::uint32_t answer) {
        when(BPF_JEQ, static_cast<std::uint32_t>(call), answer);
    }

    /// Refuses the call when its argument has any of the bits.
    void refuseBits(int call, std::size_t argument, std::uint32_t bits) {
        constexpr std::uint8_t toNext = 4;
        jump(BPF_JEQ, static_cast<std::uint32_t>(call), 0, toNext);
        load(offsetof(seccomp_data, args) + argument * sizeof(std::uint64_t));
        when(BPF_JSET, bits, kRefuse);
        give(SECCOMP_RET_ALLOW);
    }

    /// Refuses the call unless its argument has the bits.
    void requireBits(int call, std::size_t argument, std::uint32_t bits) {
        constexpr std::uint8_t toNext = 4;
        jump(BPF_JEQ, static_cast<std::uint32_t>(call), 0, toNext);
        load(offsetof(seccomp_data, args) + argument * sizeof(std::uint64_t));
        unless(BPF_JSET, bits, kRefuse);
        give(SECCOMP_RET_ALLOW);
    }

    [[nodiscard]] bool install() {
        give(SECCOMP_RET_ALLOW);
        sock_fprog program{static_cast<unsigned short>(code_.size()), code_.data()};
        return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
               ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program, 0, 0) == 0;
    }

  private:
    void load(std::size_t offset) {
        code_.push_back(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset)));
    }
    void give(std::uint32_t answer) {
        code_.push_back(BPF_STMT(BPF_RET | BPF_K, answer));
    }
    void jump(std::uint16_t test, std::uint32_t value, std::uint8_t ifTrue, std::uint8_t ifFalse) {
        code_.push_back({static_cast<std::uint16_t>(BPF_JMP | test | BPF_K), ifTrue, ifFalse, value});
    }
    void when(std::uint16_t test, std::uint32_t value, std::uint32_t answer) {
        jump(test, value, 0, 1);
        give(answer);
    }
    void unless(std::uint16_t test, std::uint32_t value, std::uint32_t answer) {
        jump(test, value, 1, 0);
        give(answer);
    }

    std::vector<sock_filter> code_;
};

}  // namespace

bool forbidSideEffects() {
    if (kArchitecture == 0) return false;
    constexpr std::size_t flagsOfOpen = 1;
    constexpr std::size_t flagsOfOpenAt = 2;
    Filter filter;
    for (const int call : kForbidden)
        filter.refuse(call, kRefuse);
    // Their flags lie in memory, where a filter can't look; libraries fall back to the older calls.
    filter.refuse(SYS_openat2, kUnknown);
    filter.refuse(SYS_clone3, kUnknown);
#ifdef SYS_open
    filter.refuseBits(SYS_open, flagsOfOpen, kWriting);
#endif
    filter.refuseBits(SYS_openat, flagsOfOpenAt, kWriting);
    filter.requireBits(SYS_clone, 0, CLONE_THREAD);
    return filter.install();
}

}  // namespace lutka
