#include "study/records/sidecars.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "base/parse_number.h"
#include "base/version.h"
#include "study/records/people_rows.h"
#include "study/records/phenotypes.h"
#include "study/records/record_rows.h"
#include "study/records/study_columns.h"
#include "study/records/trace_file.h"

namespace icome::study {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kWarning =
    "These data are SIMULATED: the program made them up, and no person took part.";
constexpr const char* kEscapes =
    "In cells a backslash before t, n, r or another one stands for tab, line feed, carriage return and "
    "backslash, \\xHH for the byte of that hexadecimal number, and n\\/a is the text n/a.";

std::string text_of(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string data_text(Json json, bool simulated) {
  json["Simulated"] = simulated;
  if (simulated) json["Warning"] = kWarning;
  return text_of(json);
}

/// The JSON file of a table's columns. BIDS takes each member for a column or a term, and wants an object.
std::string table_text(Json columns, bool simulated) {
  columns["Escapes"]["Description"] = kEscapes;
  if (simulated) columns["Simulated"]["Description"] = kWarning;
  return text_of(columns);
}

Json columns_json(const Columns& columns) {
  Json json = Json::object();
  for (const Column& column : columns) {
    Json& about = json[column.name] = Json::object();
    if (!column.description.empty()) about["Description"] = column.description;
    if (!column.unit.empty()) about["Units"] = column.unit;
    for (const ColumnLevel& level : column.levels) about["Levels"][level.id] = level.meaning;
  }
  return json;
}

/// The names of the columns of all tables, each once.
Json measured_names(const StudyFolder& folder) {
  Json names = Json::array();
  std::set<std::string> seen;
  const auto add = [&](const Columns& columns) {
    for (const Column& column : columns)
      if (seen.insert(column.name).second) names.push_back(column.name);
  };
  add(people_columns(folder));
  add(trial_columns(folder));
  add(event_columns(folder));
  for (const Questionnaire& questionnaire : folder.study.questionnaires)
    add(phenotype_columns(folder, questionnaire));
  return names;
}

/// The member of that name if it has the type that is wanted, otherwise null.
template <typename Wanted>
const Wanted* member_of(const Json& json, const char* name) {
  const auto found = json.find(name);
  return found == json.end() ? nullptr : found->get_ptr<const Wanted*>();
}

/// The number of samples a second by their own clock; n/a if it cannot be computed.
Json effective_rate_json(const Trace& trace) {
  if (trace.samples.size() < 2) return kNotAvailable;
  const double seconds = trace.samples.back().time - trace.samples.front().time;
  if (!(seconds > 0.0)) return kNotAvailable;
  return double(trace.samples.size() - 1) / seconds;
}

std::optional<std::uint64_t> parse_hash(const std::string& text) {
  constexpr std::size_t kDigits = 16;
  return text.size() == kDigits ? base::parse_number<std::uint64_t>(text, 16) : std::nullopt;
}

}  // namespace

std::string table_sidecar(const Columns& columns, bool simulated) {
  return table_text(columns_json(columns), simulated);
}

std::string phenotype_sidecar(const StudyFolder& folder, const Questionnaire& questionnaire,
                              const Columns& columns) {
  Json json;
  json["MeasurementToolMetadata"]["Description"] = first_text(questionnaire.title);
  json.update(columns_json(columns));
  return table_text(std::move(json), folder.simulated);
}

std::string trace_sidecar(const StudyFolder& folder, const Trace& trace) {
  Json json;
  json["TaskName"] = folder.study.name;
  json["TaskDescription"] = first_text(folder.study.title);
  json["SamplingFrequency"] = trace.rate_hz;
  json["SamplingFrequencyEffective"] = effective_rate_json(trace);
  json["TrackingSystemName"] = "pointer";
  json["ManufacturersModelName"] = trace.device;
  json["SoftwareVersions"] = fmt::format("icome {}", base::kVersion);
  json["TrackedPointsCount"] = 2;
  json["MotionChannelCount"] = channel_count();
  for (const char* const type : {"LATENCY", "POS", "ORNT", "MISC"})
    json[fmt::format("{}ChannelCount", type)] = channel_count(type);
  json["RecordingType"] = "continuous";
  json["RecordingDuration"] = double(trace.samples.size()) / trace.rate_hz;
  json["MissingValues"] = kNotAvailable;
  json["Touched"] = trace.things;
  return data_text(std::move(json), folder.simulated);
}

std::string description_text(const StudyFolder& folder) {
  const Study& study = folder.study;
  Json json;
  json["Name"] = fmt::format("{}{}", folder.simulated ? "SIMULATED " : "", first_text(study.title));
  json["BIDSVersion"] = "1.9.0";
  json["DatasetType"] = "raw";
  if (!study.authors.empty()) json["Authors"] = study.authors;
  json["GeneratedBy"] = Json::array({{{"Name", "icome"}, {"Version", base::kVersion}}});
  json["@context"] = "https://schema.org/";
  json["@type"] = "Dataset";
  json["name"] = json["Name"];
  json["description"] = "What people did in a user study: trials, answers and the movement of the pointer.";
  json["variableMeasured"] = measured_names(folder);
  json["StudyName"] = study.name;
  json["StudyHash"] = fmt::format("{:016x}", study.hash);
  if (!study.without.empty()) json["WithoutNeeds"] = study.without;
  return data_text(std::move(json), folder.simulated);
}

std::string readme_text(const StudyFolder& folder) {
  return fmt::format(
      "{0}{1}\n\n{2}"
      "Data of the user study '{1}', laid out as BIDS has it (https://bids.neuroimaging.io), with\n"
      "the descriptions of Psych-DS. Each table has tabs between its columns, n/a where there is no value, "
      "and\n"
      "a JSON file beside it that says what the columns are. People go by numbers; nothing here names "
      "them.\n\n"
      "study.toml           the study, as it was run\n"
      "participants.tsv     who took part, in which group and order\n"
      "sub-*/beh/           trials (_beh.tsv), and pages and answers (_events.tsv)\n"
      "sub-*/motion/        the pointer in each trial, a row a sample (_channels.tsv says what the columns "
      "are)\n"
      "phenotype/           the answers of all people, a table a questionnaire; made anew from _events.tsv\n",
      folder.simulated ? "SIMULATED " : "", folder.study.name,
      folder.simulated ? std::string(kWarning) + "\n\n" : std::string());
}

base::Result<Description> parse_description(std::string_view text, const std::string& source) {
  const Json json = Json::parse(text, nullptr, false);
  const auto* const study = member_of<Json::string_t>(json, "StudyName");
  const auto* const hash = member_of<Json::string_t>(json, "StudyHash");
  const auto* const simulated = member_of<Json::boolean_t>(json, "Simulated");
  const auto hash_value = hash == nullptr ? std::nullopt : parse_hash(*hash);
  if (study == nullptr || !hash_value || simulated == nullptr)
    return base::fail(fmt::format("{}: does not describe data of a study of icome.", source));
  Description description;
  description.hash = *hash_value;
  description.study = *study;
  description.simulated = *simulated;
  if (const auto* const needs = member_of<Json::array_t>(json, "WithoutNeeds"))
    for (const Json& need : *needs)
      if (need.is_string()) description.without.push_back(need.get<std::string>());
  return description;
}

}  // namespace icome::study
