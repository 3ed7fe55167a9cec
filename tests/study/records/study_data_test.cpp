#include <algorithm>

#include "study/data_samples.h"
#include "study/records/data_folder.h"

namespace icome::study {
namespace {

namespace fs = std::filesystem;

/// A folder with three people: one through, one who has begun, one of whom there is nothing yet.
class ReadData : public testing::Test {
 protected:
  ReadData() {
    DataFolder folder = opened(scratch_.data());
    base::Random random(9);
    for (int i = 0; i < 3; ++i) enrolled(folder);
    SessionLog first = log_of(folder, folder.participants()[0]);
    do_trials(first, 14, random);
    EXPECT_TRUE(first.add(EventRecord{EventKind::Answer, 3.0, 1.0, 0, "each.trouble", "x"}));
    EXPECT_TRUE(first.add(EventRecord{EventKind::Over, 9.0, 0.0, 0, "", ""}));
    SessionLog second = log_of(folder, folder.participants()[1]);
    do_trials(second, 3, random);
  }

  std::string error_with(const fs::path& file, const std::string& part, const std::string& instead) {
    const std::string whole = bytes_of(file);
    put_bytes(file, replaced(whole, part, instead));
    const auto data = read_study_data(scratch_.data());
    put_bytes(file, whole);
    if (data) return "read";
    const std::string& error = data.error().message;
    return error.find(file.string()) == 0 ? "F" + error.substr(file.string().size()) : error;
  }

  StudyScratch scratch_;
};

TEST_F(ReadData, GivesAll) {
  const auto data = read_study_data(scratch_.data());
  ASSERT_TRUE(data) << data.error().message;
  EXPECT_EQ(data->study.name, "data-test");
  EXPECT_FALSE(data->simulated);
  EXPECT_TRUE(data->notices.empty());
  ASSERT_EQ(data->people.size(), 3U);
  EXPECT_EQ(data->people[0].progress.trials.size(), 14U);
  EXPECT_TRUE(data->people[0].complete);
  EXPECT_EQ(data->people[1].progress.trials.size(), 3U);
  EXPECT_FALSE(data->people[1].complete);
  EXPECT_TRUE(data->people[2].progress.trials.empty());
}

TEST_F(ReadData, ChangesNothing) {
  const std::string whole = bytes_of(trials_file(scratch_.data()));
  put_bytes(trials_file(scratch_.data()), whole.substr(0, whole.size() - 5));
  fs::remove(trace_file(scratch_.data(), "002"));
  fs::remove(scratch_.data() / "README");
  const auto data = read_study_data(scratch_.data());
  ASSERT_TRUE(data);
  EXPECT_EQ(data->people[0].progress.trials.size(), 13U);
  EXPECT_EQ(data->notices.size(), 3U);
  EXPECT_EQ(bytes_of(trials_file(scratch_.data())), whole.substr(0, whole.size() - 5));
  EXPECT_FALSE(fs::exists(scratch_.data() / "README"));
}

TEST_F(ReadData, TellsOfTrialsAndPeopleThatWereTakenAway) {
  const std::string whole = bytes_of(trials_file(scratch_.data()));
  put_bytes(trials_file(scratch_.data()), whole.substr(0, whole.rfind('\n', whole.size() - 2) + 1));
  fs::create_directories(scratch_.data() / "sub-009");
  const auto data = read_study_data(scratch_.data());
  ASSERT_TRUE(data);
  ASSERT_EQ(data->notices.size(), 2U);
  EXPECT_NE(data->notices[0].find("sub-009: is left out"), std::string::npos);
  EXPECT_NE(data->notices[1].find("measured trials of 001, who is through"), std::string::npos);
}

TEST_F(ReadData, NeedsTheFilesOfAStudy) {
  const auto nothing = read_study_data(scratch_.path());
  ASSERT_FALSE(nothing);
  EXPECT_NE(nothing.error().message.find("dataset_description.json: is missing"), std::string::npos);
  EXPECT_EQ(error_with(scratch_.data() / "study.toml", "seed = 5", "seed = 6"),
            "F: is not the study that these data are of; put it back as it was.");
  EXPECT_EQ(error_with(scratch_.data() / "dataset_description.json", "StudyHash", "StudyBash"),
            "F: does not describe data of a study of icome.");
  EXPECT_EQ(error_with(scratch_.data() / "dataset_description.json", "{", "["),
            "F: does not describe data of a study of icome.");
  EXPECT_NE(error_with(scratch_.data() / "study.toml", "[trials]", "[trails]"), "read");
}

TEST_F(ReadData, NamesTheLineThatIsWrong) {
  const fs::path file = trials_file(scratch_.data());
  EXPECT_EQ(error_with(file, "trial\tphase", "trail\tphase").substr(0, 27), "F:1: the header is not 'tri");
  EXPECT_EQ(error_with(file, "\n2\tmeasured", "\n3\tmeasured"),
            "F:3: trial: '3' is not the number of the next trial.");
  EXPECT_EQ(error_with(file, "\n2\tmeasured", "\n2\tmessured"),
            "F:3: phase: 'messured' is none of those it can be; did you mean 'measured'?");
  EXPECT_EQ(error_with(file, "\n2\tmeasured\t1", "\n2\tmeasured\tx"),
            "F:3: position: 'x' is no whole number.");
  EXPECT_EQ(error_with(file, "\n2\tmeasured\t1", "\n2\tmeasured\t0"),
            "F:3: the person does not have this condition at position 0.");
  EXPECT_EQ(error_with(file, "\n3\tmeasured", "\n3\tpractice"),
            "F:4: the trial is out of sequence: practice was over.");
  EXPECT_EQ(error_with(file, "run-002", "run-003"),
            "F:3: trace: 'motion/sub-001_task-datatest_tracksys-po...' is not the trace of this trial.");
  EXPECT_EQ(error_with(file, "\n2\t", "\n2\t\t"), "F:3: has 16 columns, and the table has 15.");
  EXPECT_EQ(error_with(file, "\n2\t", std::string("\n2\0\t", 4)),
            "F:3: trial holds the control character 0; was the file saved by another program?");
  const fs::path events = events_file(scratch_.data());
  EXPECT_EQ(error_with(events, "\n3\t1\t", "\n3\t1e\t"), "F:2: duration: '1e' is no number.");
  EXPECT_EQ(error_with(events, "\n3\t1\t", "\n3\tnan\t"), "F:2: duration: 'nan' is no number.");
  EXPECT_EQ(error_with(events, "each.trouble", "each.truble"),
            "F:2: the study has no question 'each.truble'.");
  EXPECT_EQ(error_with(events, "\tover\t", "\tlover\t"),
            "F:3: trial_type: 'lover' is none of those it can be; did you mean 'over'?");
}

TEST_F(ReadData, NoBytesMakeItFall) {
  const std::vector<fs::path> files = {trials_file(scratch_.data()), events_file(scratch_.data()),
                                       scratch_.data() / "participants.tsv",
                                       scratch_.data() / "dataset_description.json"};
  base::Random random(31);
  for (int i = 0; i < 800; ++i) {
    const fs::path& file = files[random.index(files.size())];
    const std::string whole = bytes_of(file);
    std::string damaged = whole;
    for (std::uint64_t changes = 1 + random.index(4); changes > 0; --changes) {
      const std::size_t place = random.index(damaged.size());
      const char byte =
          random.index(2) == 0 ? char(random.bits()) : "\t\n\\0123456789-en/a"[random.index(18)];
      switch (random.index(3)) {
        case 0:
          damaged[place] = byte;
          break;
        case 1:
          damaged.insert(place, random.index(5) == 0 ? 1000 : 1, byte);
          break;
        default:
          damaged.erase(place, 1 + random.index(30));
      }
    }
    put_bytes(file, damaged);
    const auto data = read_study_data(scratch_.data());
    if (!data) {
      EXPECT_EQ(data.error().message.find(file.string()), 0U) << data.error().message;
    }
    put_bytes(file, whole);
  }
}

}  // namespace
}  // namespace icome::study
