#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "animation/files/project_text.h"

namespace icome::animation {

/// A project of a file, and what was done to it since the file was written and would be lost with the
/// program: the journal beside it has that.
struct ProjectRead {
  Project project;
  std::size_t recovered = 0;         ///< edits of the journal that are in `project` and not in the file
  std::optional<Project> as_saved;   ///< as the file itself has it; none where nothing was recovered
  std::uint64_t hash = 0;            ///< hash_of_text() of the file
  std::uint64_t journal_length = 0;  ///< bytes of the journal that were whole; 0: there is none that fits
  std::string note;                  ///< about the journal, for people; mostly empty
};

/// Reads a .cutout file, and what a journal beside it adds. Fails with file and line.
base::Result<ProjectRead> read_project_file(const std::filesystem::path& path);

/// A number that another text almost surely does not have (FNV-1a).
std::uint64_t hash_of_text(std::string_view text);
/// That of a file's text; none where there is no such file, or it cannot be read.
std::optional<std::uint64_t> hash_of_file(const std::filesystem::path& path);

/// Writes a .cutout file, which appears whole or not at all.
base::Result<void> write_project_file(const Project& project, const std::filesystem::path& path);

/// The journal of a file: ".boat.cutout.journal" beside "boat.cutout".
std::filesystem::path journal_of(const std::filesystem::path& file);

/// Edits of an open project on the disk, as they are made, so that a crash loses nothing: a line each, after
/// the hash of the text that they start from.
class ProjectJournal {
 public:
  enum class Line : std::uint8_t {
    Edit,
    Part,   ///< of a recording that goes on: it counts where the program ends before the whole is there
    Whole,  ///< a recording that has ended: it takes the place of its parts
  };

  /// Begins the journal of a file, as it lies on the disk, that was read or written just now: goes on after
  /// `length` bytes of the one that is there (ProjectRead::journal_length), or begins a new one; one of
  /// another version of the file is moved aside, to a name that ends with ".old". Fails with the path, and
  /// where another program has the file open.
  static base::Result<ProjectJournal> open(const std::filesystem::path& file, std::uint64_t length = 0);

  /// Does a window of this or another program have the file open, with a journal?
  static bool is_open(const std::filesystem::path& file);

  ProjectJournal(ProjectJournal&&) noexcept;
  ProjectJournal& operator=(ProjectJournal&&) noexcept;
  ~ProjectJournal();

  /// Adds a line, and waits until the disk has it. Fails with the path and the system's message.
  base::Result<void> add(const ProjectEdit& edit, Line line = Line::Edit);
  /// Takes the journal away: the project is saved, or given up.
  void remove();

 private:
  struct File;
  explicit ProjectJournal(std::unique_ptr<File> file);
  base::Result<void> write(std::string_view bytes);
  std::unique_ptr<File> file_;
};

}  // namespace icome::animation
