#include "study/records/data_folder.h"

#include <sys/wait.h>

#include <algorithm>
#include <set>

#include "study/data_samples.h"

namespace icome::study {
namespace {

namespace fs = std::filesystem;

std::string enrol_error(DataFolder& folder, const std::optional<std::string>& id,
                        const std::vector<std::string>& control = {"f", "30"}, std::size_t language = 0) {
  const auto person = folder.enrol(id, language, control);
  return person ? "enrolled" : person.error().message;
}

/// "a b c"
std::string ids_of(const std::vector<Participant>& people) {
  std::string ids;
  for (const Participant& person : people) ids.append(ids.empty() ? "" : " ").append(person.id);
  return ids;
}

TEST(DataFolder, IsMadeWithWhatBidsAsksFor) {
  const StudyScratch scratch;
  const DataFolder folder = opened(scratch.path() / "new" / "data");
  EXPECT_EQ(folder.path(), scratch.path() / "new" / "data");
  EXPECT_EQ(bytes_of(folder.path() / "study.toml"), kDataStudy);
  const std::string description = bytes_of(folder.path() / "dataset_description.json");
  for (const char* const member :
       {R"("Name": "A \"test\"")", R"("BIDSVersion": "1.9.0")", R"("DatasetType": "raw")",
        R"("@type": "Dataset")", R"("Simulated": false)", R"("StudyName": "data-test")"})
    EXPECT_NE(description.find(member), std::string::npos) << member;
  EXPECT_EQ(bytes_of(folder.path() / "participants.tsv"),
            "participant_id\tnumber\tgroup\tway\torder_row\torder\tlanguage\tgroup_\tage\n");
  EXPECT_NE(bytes_of(folder.path() / "participants.json").find(R"("Units": "years")"), std::string::npos);
  EXPECT_FALSE(bytes_of(folder.path() / "README").empty());
}

TEST(DataFolder, OpensAgainWithThePeopleInIt) {
  const StudyScratch scratch;
  std::vector<Participant> people;
  {
    DataFolder folder = opened(scratch.data());
    people.push_back(enrolled(folder));
    people.push_back(folder.enrol("007", 1, {"m", ""}).value());
    people.push_back(folder.enrol(std::nullopt, 0, {"m", "n/a"}).value());
  }
  const DataFolder folder = opened(scratch.data());
  EXPECT_EQ(ids_of(folder.participants()), "001 007 003");
  for (std::size_t i = 0; i < people.size(); ++i) {
    const Participant& person = folder.participants()[i];
    EXPECT_EQ(person.number, i);
    EXPECT_EQ(person.group, people[i].group);
    EXPECT_EQ(person.order_row, people[i].order_row);
    EXPECT_EQ(person.language, people[i].language);
    EXPECT_EQ(person.control, people[i].control);
  }
  EXPECT_EQ(folder.participants()[2].control, (std::vector<std::string>{"m", ""}));
  const std::string rows = bytes_of(scratch.data() / "participants.tsv");
  EXPECT_NE(rows.find("\nsub-007\t2\t"), std::string::npos);
}

TEST(DataFolder, GroupsAreBalanced) {
  const StudyScratch scratch;
  DataFolder folder = opened(scratch.data());
  std::size_t women[2] = {}, men[2] = {};
  for (int i = 0; i < 20; ++i) {
    const auto person = folder.enrol(std::nullopt, 0, {i % 4 == 0 ? "f" : "m", ""});
    ASSERT_TRUE(person);
    ++(i % 4 == 0 ? women : men)[person->group];
  }
  EXPECT_LE(women[0] > women[1] ? women[0] - women[1] : women[1] - women[0], 1U);
  EXPECT_LE(men[0] > men[1] ? men[0] - men[1] : men[1] - men[0], 1U);
}

TEST(DataFolder, RefusesAnotherStudy) {
  const StudyScratch scratch;
  {
    DataFolder folder = opened(scratch.data());
    enrolled(folder);
  }
  const std::string path = scratch.data().string();
  EXPECT_EQ(open_error(scratch.data(), replaced(kDataStudy, "data-test", "other")),
            path + ": holds data of the study 'data-test', not of 'other'; give another folder.");
  EXPECT_EQ(
      open_error(scratch.data(), replaced(kDataStudy, "seed = 5", "seed = 6")),
      path +
          ": holds data of this study as it was before the study file was changed. Put the study file back "
          "as it was (a copy is " +
          path + "/study.toml), or give another folder.");
  EXPECT_EQ(open_error(scratch.data(), kDataStudy, true),
            path + ": holds real data, which simulated ones must not come among; give another folder.");
  // The layout of the file is not the study.
  EXPECT_EQ(open_error(scratch.data(), "# a remark\n" + kDataStudy), "opened");
  EXPECT_EQ(bytes_of(scratch.data() / "study.toml"), kDataStudy);
}

TEST(DataFolder, BindsToNothingWhileNobodyIsEnrolled) {
  const StudyScratch scratch;
  opened(scratch.data());
  const std::string changed = replaced(kDataStudy, "seed = 5", "seed = 6");
  EXPECT_EQ(open_error(scratch.data(), changed, true), "opened");
  EXPECT_EQ(bytes_of(scratch.data() / "study.toml"), changed);
  fs::remove(scratch.data() / "dataset_description.json");  // as a kill leaves it
  EXPECT_EQ(open_error(scratch.data()), "opened");
  EXPECT_EQ(bytes_of(scratch.data() / "study.toml"), kDataStudy);
  EXPECT_TRUE(read_study_data(scratch.data()));
}

TEST(DataFolder, KeepsTheScenesAndRefusesOthers) {
  const StudyScratch scratch;
  const auto open_with = [&](const std::string& room) {
    auto folder = DataFolder::open(study_of(kDataStudy), kDataStudy, scratch.data(), false,
                                   {{"rooms/one.wrl", room}, {"../two.wrl", "2"}});
    if (folder && folder->participants().empty()) enrolled(*folder);
    return folder ? "opened" : folder.error().message;
  };
  EXPECT_EQ(open_with("a room"), "opened");
  EXPECT_EQ(bytes_of(scratch.data() / "stimuli/rooms/one.wrl"), "a room");
  EXPECT_EQ(bytes_of(scratch.data() / "stimuli/outside-2/two.wrl"), "2");
  EXPECT_EQ(open_with("a room"), "opened");
  EXPECT_EQ(open_with("another"),
            "rooms/one.wrl: was another scene when these data were begun. Put it back as it "
            "was (a copy is " +
                (scratch.data() / "stimuli/rooms/one.wrl").string() + "), or give another folder.");
}

TEST(DataFolder, ScenesOfOneNameFromElsewhereAreKeptApart) {
  const StudyScratch scratch;
  for (int time = 0; time < 2; ++time)
    EXPECT_TRUE(DataFolder::open(study_of(kDataStudy), kDataStudy, scratch.data(), false,
                                 {{"../a/room.wrl", "a"}, {"../b/room.wrl", "b"}, {"../a/room.wrl", "a"}}));
  EXPECT_EQ(bytes_of(scratch.data() / "stimuli/outside-1/room.wrl"), "a");
  EXPECT_EQ(bytes_of(scratch.data() / "stimuli/outside-2/room.wrl"), "b");
}

TEST(DataFolder, IdsThatPeopleMixUpAreTheSame) {
  const StudyScratch scratch;
  DataFolder folder = opened(scratch.data());
  enrolled(folder);
  enrolled(folder, "p1");
  EXPECT_NE(folder.enrol("1", 0, {"f", "30"}).error().message.find("001 has begun"), std::string::npos);
  EXPECT_NE(folder.enrol("P1", 0, {"f", "30"}).error().message.find("p1 has begun"), std::string::npos);
  EXPECT_TRUE(folder.enrol("11", 0, {"f", "30"}));
}

TEST(DataFolder, RefusesFoldersThatHoldOtherThings) {
  const StudyScratch scratch;
  scratch.write("file", "x");
  EXPECT_NE(open_error(scratch.path()).find("give a new or an empty folder"), std::string::npos);
  EXPECT_NE(open_error(scratch.path() / "file").find("is a file, not a folder"), std::string::npos);
  scratch.write("dataset_description.json", R"({"Name": "brains"})");
  EXPECT_NE(open_error(scratch.path()).find("Give another folder"), std::string::npos);
  scratch.write("dataset_description.json", std::string(100000, '['));
  EXPECT_NE(open_error(scratch.path()).find("Give another folder"), std::string::npos);
  EXPECT_FALSE(fs::exists(scratch.path() / "study.toml"));
}

TEST(DataFolder, MakesAgainWhatTheStudySays) {
  const StudyScratch scratch;
  opened(scratch.data());
  for (const char* const name : {"README", "study.toml", "participants.json"})
    fs::remove(scratch.data() / name);
  opened(scratch.data());
  for (const char* const name : {"README", "study.toml", "participants.json"})
    EXPECT_TRUE(fs::exists(scratch.data() / name)) << name;
}

TEST(DataFolder, AsksForWhatOnlyPeopleKnow) {
  const StudyScratch scratch;
  {
    DataFolder folder = opened(scratch.data());
    enrolled(folder);
  }
  fs::rename(scratch.data() / "participants.tsv", scratch.path() / "kept");
  EXPECT_NE(open_error(scratch.data()).find("participants.tsv: is missing"), std::string::npos);
  fs::rename(scratch.path() / "kept", scratch.data() / "participants.tsv");
  fs::remove(scratch.data() / "dataset_description.json");
  EXPECT_NE(open_error(scratch.data()).find("dataset_description.json: is missing"), std::string::npos);
}

TEST(DataFolder, GoesOnWithAFolderThatWasHalfMade) {
  const StudyScratch scratch;
  opened(scratch.data());
  fs::remove(scratch.data() / "dataset_description.json");
  fs::remove(scratch.data() / "participants.tsv");
  scratch.write("data/.README.part", "half");
  DataFolder folder = opened(scratch.data());
  EXPECT_EQ(enrolled(folder).id, "001");
}

TEST(DataFolder, IdsAreLettersAndDigits) {
  const StudyScratch scratch;
  DataFolder folder = opened(scratch.data());
  EXPECT_EQ(enrolled(folder, "Abc9").id, "Abc9");
  for (const char* const id : {"", "a b", "../x", "a_b", "a-b", "é", "a\n"})
    EXPECT_NE(enrol_error(folder, id).find("take letters and digits, at most 32"), std::string::npos) << id;
  EXPECT_EQ(enrol_error(folder, std::string(32, 'a')), "enrolled");
  EXPECT_NE(enrol_error(folder, std::string(33, 'a')), "enrolled");
  EXPECT_EQ(enrol_error(folder, "SIMULATED001"),
            "the id SIMULATED001 is kept for simulated people; take another.");
}

TEST(DataFolder, RefusesThePersonTwice) {
  const StudyScratch scratch;
  DataFolder folder = opened(scratch.data());
  const Participant person = enrolled(folder, "007");
  EXPECT_EQ(enrol_error(folder, "007"),
            "007 has begun: icome study resume ... --participant 007 goes on with that session.");
  ASSERT_TRUE(log_of(folder, person).add(EventRecord{EventKind::Over, 1.0, 0.0, 0, "", ""}));
  EXPECT_EQ(enrol_error(folder, "007"),
            "007 is through; nobody takes part twice. Take another id for the next person.");
  fs::create_directory(scratch.data() / "sub-008");
  EXPECT_NE(enrol_error(folder, "008").find("move it elsewhere or take another id"), std::string::npos);
}

TEST(DataFolder, RefusesAnswersThatAreNone) {
  const StudyScratch scratch;
  DataFolder folder = opened(scratch.data());
  EXPECT_EQ(enrol_error(folder, "1", {"x", "30"}), "'group' has no level 'x'; there are f, m.");
  EXPECT_EQ(enrol_error(folder, "1", {"f", "thirty"}), "'age' is a number, and 'thirty' is none.");
  EXPECT_EQ(enrol_error(folder, "1", {"f", "inf"}), "'age' is a number, and 'inf' is none.");
  EXPECT_EQ(enrol_error(folder, "1", {"", "30"}),
            "'group' is missing, and the groups are balanced by it; give a level.");
  EXPECT_EQ(enrol_error(folder, "1", {"f"}), "there are 1 answers for the 2 control variables of the study.");
  EXPECT_EQ(enrol_error(folder, "1", {"f", ""}, 2),
            "the study does not speak that language; take one of its own.");
  EXPECT_TRUE(folder.participants().empty());
}

TEST(DataFolder, FindsWhoIsThere) {
  const StudyScratch scratch;
  DataFolder folder = opened(scratch.data());
  enrolled(folder, "alice1");
  DataFolder other = opened(scratch.data());
  enrolled(other, "bob22");  // enrolled by another program
  EXPECT_EQ(folder.find("bob22").value().number, 1U);
  EXPECT_EQ(folder.find("alice").error().message, "nobody has the id alice; did you mean 'alice1'?");
  EXPECT_EQ(folder.find("zzzzzz").error().message, "nobody has the id zzzzzz; there are alice1, bob22.");
  EXPECT_FALSE(folder.open_log(Participant{"zzzzzz", 0, 0, 0, 0, {}}));
}

TEST(DataFolder, WhoIsNotThroughIsUnfinished) {
  const StudyScratch scratch;
  DataFolder folder = opened(scratch.data());
  for (int i = 0; i < 3; ++i) enrolled(folder);
  ASSERT_TRUE(
      log_of(folder, folder.find("002").value()).add(EventRecord{EventKind::Over, 1.0, 0.0, 0, "", ""}));
  EXPECT_EQ(ids_of(folder.unfinished().value()), "001 003");
}

TEST(DataFolder, SimulatedPeopleAreMarkedEverywhere) {
  const StudyScratch scratch;
  DataFolder folder = opened(scratch.data(), kDataStudy, true);
  const Participant person = enrolled(folder);
  EXPECT_EQ(person.id, "SIMULATED001");
  EXPECT_EQ(enrolled(folder, "x").id, "SIMULATEDx");
  EXPECT_EQ(folder.find("x").value().id, "SIMULATEDx");
  base::Random random(3);
  {
    SessionLog log = log_of(folder, person);
    do_trials(log, 2, random);
    ASSERT_TRUE(log.add(EventRecord{EventKind::Answer, 1.0, 1.0, 0, "each.trouble", "nothing"}));
    ASSERT_TRUE(log.add(EventRecord{EventKind::Over, 2.0, 0.0, 0, "", ""}));
  }
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(scratch.data())) {
    const fs::path& file = entry.path();
    const std::string bytes = entry.is_regular_file() ? bytes_of(file) : "";
    if (file.extension() == ".json") {
      EXPECT_NE(bytes.find("\"Simulated\": "), std::string::npos) << file;
      EXPECT_NE(bytes.find("\": \"These data are SIMULATED"), std::string::npos) << file;
    }
    if (file.extension() == ".tsv" && !file.filename().string().ends_with("_motion.tsv")) {
      EXPECT_NE(bytes.find("\tdata\n"), std::string::npos) << file;
      for (std::size_t end = bytes.find('\n', bytes.find('\n') + 1); end != bytes.npos;
           end = bytes.find('\n', end + 1))
        EXPECT_EQ(bytes.substr(end - 10, 10), "\tSIMULATED") << file;
    }
    if (file.string().find("sub-") != std::string::npos) {
      EXPECT_NE(file.string().find("sub-SIMULATED"), std::string::npos);
    }
  }
  EXPECT_NE(bytes_of(scratch.data() / "dataset_description.json").find("\"Name\": \"SIMULATED A"),
            std::string::npos);
  EXPECT_NE(open_error(scratch.data()).find("holds simulated data, which real ones"), std::string::npos);
}

TEST(DataFolder, EveryTornRowOfPeopleIsPutRight) {
  const StudyScratch scratch;
  {
    DataFolder folder = opened(scratch.data());
    enrolled(folder);
    enrolled(folder);
  }
  const fs::path file = scratch.data() / "participants.tsv";
  const std::string whole = bytes_of(file);
  const std::size_t first_end = whole.find('\n', whole.find('\n') + 1) + 1;
  for (std::size_t size = whole.find('\n') + 1; size < whole.size(); ++size) {
    put_bytes(file, whole.substr(0, size));
    DataFolder folder = opened(scratch.data());
    const std::string next = size < first_end ? "001" : "002";
    EXPECT_EQ(folder.participants().size(), size < first_end ? 0U : 1U);
    EXPECT_EQ(enrolled(folder).id, next) << size;
    EXPECT_EQ(bytes_of(file), whole.substr(0, size < first_end ? first_end : whole.size()));
  }
}

TEST(DataFolder, ProgramsMayEnrolAtATime) {
  const StudyScratch scratch;
  opened(scratch.data());
  constexpr int kPrograms = 2;
  constexpr int kEach = 20;
  for (int program = 0; program < kPrograms; ++program) {
    if (::fork() != 0) continue;
    DataFolder folder = opened(scratch.data());
    bool all = true;
    for (int i = 0; i < kEach; ++i)
      all = all && folder.enrol(std::nullopt, 0, {i % 2 == 0 ? "f" : "m", ""}).has_value();
    ::_exit(all ? 0 : 1);
  }
  for (int program = 0; program < kPrograms; ++program) {
    int status = -1;
    ::wait(&status);
    EXPECT_EQ(status, 0);
  }
  const DataFolder folder = opened(scratch.data());
  std::set<std::string> ids;
  std::size_t in_group[2] = {};
  for (const Participant& person : folder.participants()) {
    ids.insert(person.id);
    ++in_group[person.group];
  }
  EXPECT_EQ(ids.size(), std::size_t(kPrograms * kEach));
  EXPECT_EQ(*ids.rbegin(), "040");
  EXPECT_LE(in_group[0] > in_group[1] ? in_group[0] - in_group[1] : in_group[1] - in_group[0], 2U);
}

TEST(DataFolder, ReadsOnlyPeopleThatItWouldWrite) {
  const StudyScratch scratch;
  {
    DataFolder folder = opened(scratch.data());
    enrolled(folder);
    enrolled(folder);
  }
  const fs::path file = scratch.data() / "participants.tsv";
  const std::string whole = bytes_of(file);
  const auto error_with = [&](const std::string& part, const std::string& instead) {
    put_bytes(file, replaced(whole, part, instead));
    return replaced(open_error(scratch.data()), file.string(), "P");
  };
  EXPECT_EQ(error_with("sub-001", "sub-0 1"),
            "P:2: participant_id: 'sub-0 1' is not sub- with letters and digits.");
  EXPECT_EQ(error_with("sub-002", "sub-001"), "P:3: sub-001 is there twice.");
  EXPECT_EQ(error_with("sub-001", "sub-SIMULATED1"),
            "P:2: participant_id: 'sub-SIMULATED1' mixes simulated and real people.");
  EXPECT_EQ(error_with("sub-002\t2", "sub-002\t1"), "P:3: the rows are out of order.");
  EXPECT_EQ(error_with("sub-001\t1", "sub-001\t0"), "P:2: number: '0' is out of order.");
  EXPECT_EQ(error_with("\tf\t", "\tq\t"), "P:2: group_: 'q' is no answer to this variable.");
  EXPECT_EQ(error_with("\ten\t", "\tfr\t"),
            "P:2: language: 'fr' is none of those it can be; there are en, nl.");
  EXPECT_EQ(error_with("\tgroup\t", "\tgrouq\t").substr(0, 25), "P:1: the header is not 'p");
  EXPECT_NE(error_with("; ", ", ").find("is not the order that this person has"), std::string::npos);
}

}  // namespace
}  // namespace icome::study
