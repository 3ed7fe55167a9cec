#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace icome::animation {

/// The program ffmpeg at work: it is fed through its standard input, and what it complains about is kept.
/// Ends with this, by force where it has not before.
class Ffmpeg {
 public:
  /// A file that the program finds as /dev/fd/NUMBER.
  struct HandedFile {
    int ours = -1;    ///< descriptor here
    int theirs = -1;  ///< 3 to 9
  };

  /// Finds the program on the PATH and starts it, without a shell. Fails, saying what to install, where it is
  /// not there.
  static base::Result<Ffmpeg> start(const std::vector<std::string>& arguments,
                                    const std::vector<HandedFile>& files);
  Ffmpeg(Ffmpeg&& other) noexcept;
  Ffmpeg& operator=(Ffmpeg&&) = delete;
  ~Ffmpeg();

  /// Is asked every tenth of a second while ffmpeg is waited for; false ends the wait.
  using GoesOn = std::function<bool()>;
  /// Feeds bytes. Fails where ffmpeg has ended, with what it said, and where `goes_on` says no.
  base::Result<void> feed(std::string_view bytes, const GoesOn& goes_on);
  /// Tells it that there is no more, and waits for its end. Fails with what it said where it fails.
  base::Result<void> finish(const GoesOn& goes_on);

 private:
  Ffmpeg(int process, int input, int complaints)
      : process_(process), input_(input), complaints_(complaints) {}
  void hear();
  tl::unexpected<base::Error> failed();

  pid_t process_ = 0;    // 0: has ended
  int input_ = -1;       // socket; -1: closed
  int complaints_ = -1;  // pipe; -1: its other end is closed
  std::string said_;     // its first kilobytes
};

}  // namespace icome::animation
