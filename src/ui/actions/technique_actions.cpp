#include "ui/actions/technique_actions.h"

#include <fmt/format.h>

#include <QFileDialog>
#include <algorithm>
#include <string>

#include "session/storage/recording_files.h"
#include "ui/actions/actions.h"
#include "ui/actions/recent_files.h"

namespace icome::ui {
namespace {

using interaction::Holding;
using interaction::Selecting;
using interaction::Travelling;

constexpr const char* kSelectingKey = "technique/selecting";
constexpr const char* kHoldingKey = "technique/holding";
constexpr const char* kTravellingKey = "technique/travelling";
constexpr const char* kTopic = "recording";

struct SelectingEntry {
  Selecting selecting;
  Holding suits;  // the holding that goes with it, unless another is chosen
  const char* name;
  const char* text;
  const char* hint;
};
constexpr SelectingEntry kSelectingEntries[] = {
    {Selecting::VirtualHand, Holding::Hand, "technique.virtual_hand", "&Virtual Hand",
     "What the hand is in or near to. The mouse puts the hand on what is under it"},
    {Selecting::GoGo, Holding::GoGo, "technique.go_go", "&Go-Go",
     "As the virtual hand, with an arm that grows beyond the middle of the workspace"},
    {Selecting::RayPointer, Holding::AlongRay, "technique.ray", "&Ray",
     "What the stylus points at first. With the mouse, what is under it"},
    {Selecting::Spotlight, Holding::AlongRay, "technique.spotlight", "&Spotlight",
     "Of what is in a cone of light from the stylus, what is nearest to its middle"},
    {Selecting::Miniature, Holding::Miniature, "technique.miniature", "World in &Miniature",
     "What the hand touches in a small copy of the world, before the eyes or on the other hand"},
    {Selecting::LookAt, Holding::Hand, "technique.look_at", "&Look-at",
     "What is in the middle of the picture; the button of any place holds it"},
};

struct HoldingEntry {
  Holding holding;
  const char* name;
  const char* text;
};
constexpr HoldingEntry kHoldingEntries[] = {
    {Holding::Hand, "technique.hold.hand", "With the &Hand"},
    {Holding::GoGo, "technique.hold.go_go", "With an Arm That &Grows"},
    {Holding::AlongRay, "technique.hold.ray", "On the &Ray (buttons 2 and 3 push and pull)"},
    {Holding::Miniature, "technique.hold.miniature", "With Its Copy in the &Miniature"},
    {Holding::TwoHands, "technique.hold.two_hands", "With &Two Hands, Which Turn and Scale"},
    {Holding::ScaledWorld, "technique.hold.scaled_world", "In a World That Has &Shrunk"},
};

struct TravellingEntry {
  Travelling travelling;
  const char* name;
  const char* text;
};
constexpr TravellingEntry kTravellingEntries[] = {
    {Travelling::None, "technique.travel.none", "&Nowhere"},
    {Travelling::Fly, "technique.travel.fly", "&Fly to Where the Hand Points"},
    {Travelling::Teleport, "technique.travel.teleport", "&Teleport to Where the Hand Points"},
    {Travelling::Orbit, "technique.travel.orbit", "&Orbit with Two Hands"},
    {Travelling::Miniature, "technique.travel.miniature", "Move the Likeness in the &Miniature"},
};

/// The entry that the settings name; null: none of them.
template <typename Entries, typename Way>
auto chosen_entry(const Entries& entries, Way way, const QSettings& settings, const char* key) {
  const std::string name = settings.value(key).toString().toStdString();
  const auto found = std::find_if(std::begin(entries), std::end(entries),
                                  [&](const auto& it) { return name_of(it.*way) == name; });
  return found == std::end(entries) ? nullptr : &*found;
}

}  // namespace

TechniqueActions::TechniqueActions(session::Session& session, QSettings& settings, QWidget& window,
                                   std::function<void(const Note&)> tell)
    : session_(session), settings_(settings), window_(window), tell_(std::move(tell)) {}

/// Ends a recording first, as it is one of the technique before.
void TechniqueActions::choose(const char* key, std::string_view name) {
  end_recording();
  settings_.setValue(key, QString::fromUtf8(name.data(), qsizetype(name.size())));
  apply();
  chosen_();
}

/// Applies the chosen technique, in sizes that suit the device and the view as they are now.
void TechniqueActions::apply() {
  const auto* selecting =
      chosen_entry(kSelectingEntries, &SelectingEntry::selecting, settings_, kSelectingKey);
  if (!selecting) {
    (void)session_.techniques().set(std::nullopt);
    show_recording();
    return;
  }
  const auto* holding = chosen_entry(kHoldingEntries, &HoldingEntry::holding, settings_, kHoldingKey);
  const auto* travelling =
      chosen_entry(kTravellingEntries, &TravellingEntry::travelling, settings_, kTravellingKey);
  const double reach =
      session_.hands().pointers() > 0 ? session_.hands().pointer_info(0).workspace_radius : 0.1;
  // This cannot fail: sizes for a desk are valid.
  (void)session_.techniques().set(session::desk_technique(
      selecting->selecting, holding ? holding->holding : selecting->suits,
      travelling ? travelling->travelling : Travelling::None, reach, session_.view().now().distance));
  show_recording();
}

QString TechniqueActions::name() const {
  const auto* found = chosen_entry(kSelectingEntries, &SelectingEntry::selecting, settings_, kSelectingKey);
  return found ? QString(found->text).remove('&') : QString();
}

QString TechniqueActions::hint() const {
  const QString by = name();
  if (by.isEmpty()) return {};
  if (session_.techniques().current() && session_.techniques().current()->is_getting_ready())
    return by + ": getting ready to meet what is in the scene; solids and scans take their time";
  return by +
         ": press to take what is meant and drag it, Ctrl and press to travel, turn the wheel while pressing "
         "to move the hand nearer or farther (Tools > Technique)";
}

void TechniqueActions::show_recording() {
  const bool is_recording = !recorded_to_.empty();
  record_->setText(is_recording ? "Stop &Recording" : "&Record\u2026");
  record_->setEnabled(is_recording || session_.techniques().current());
}

void TechniqueActions::choose_recording() {
  if (!recorded_to_.empty()) return end_recording();
  auto* dialog = new QFileDialog(&window_, "Record What Is Done Into");
  dialog->setObjectName("record");
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setAcceptMode(QFileDialog::AcceptSave);
  dialog->setNameFilter("Recordings (*.recording)");
  dialog->setDefaultSuffix("recording");
  if (!session_.files().path().empty()) dialog->setDirectory(text_of(session_.files().path().parent_path()));
  dialog->selectFile(session_.files().path().empty() ? QString("Untitled")
                                                     : text_of(session_.files().path().stem()));
  QObject::connect(dialog, &QFileDialog::fileSelected, &window_,
                   [this](const QString& path) { begin_recording(path_of(path)); });
  dialog->open();
}

void TechniqueActions::begin_recording(const std::filesystem::path& path) {
  const auto begun = session_.techniques().record();
  if (!begun) return tell_({.weight = Note::Weight::Error, .text = begun.error().message, .topic = kTopic});
  recorded_to_ = path;
  show_recording();
  tell_(
      {.text = "What the hands do is recorded, until Tools > Technique > Stop Recording.", .topic = kTopic});
}

void TechniqueActions::end_recording() {
  const std::filesystem::path path = std::exchange(recorded_to_, {});
  if (path.empty()) return;
  const auto recorded = session_.techniques().stop_recording();
  show_recording();
  if (!recorded) return;
  if (const auto written = session::write_recording(path, *recorded); !written)
    return tell_({.weight = Note::Weight::Error, .text = written.error().message, .topic = kTopic});
  const std::string name = path.filename().string();
  tell_({.text = fmt::format("{} is written, and beside it {}, which it began with.{}", name,
                             session::beginning_of(path).filename().string(),
                             recorded->is_whole ? "" : " It ends where something else changed the design."),
         .topic = kTopic,
         .details = {fmt::format("To do it once more: icome edit {} --replay {} --out again.icome",
                                 session::beginning_of(path).string(), path.string())}});
}

void TechniqueActions::fill(QMenu& menu) {
  QMenu* techniques = menu.addMenu("Techni&que");
  techniques->setObjectName("technique");
  techniques->setToolTipsVisible(true);
  auto* group = new QActionGroup(techniques);
  const auto* chosen = chosen_entry(kSelectingEntries, &SelectingEntry::selecting, settings_, kSelectingKey);
  const auto add = [&](const char* name, const char* text, const char* hint, bool checked,
                       std::string_view saved) {
    QAction* action =
        add_action(*techniques, name, text, {}, [this, saved] { choose(kSelectingKey, saved); });
    action->setToolTip(hint);
    action->setCheckable(true);
    action->setChecked(checked);
    group->addAction(action);
  };
  add("technique.touch", "&Touch", "What the hand touches, which can be felt", !chosen, "touch");
  for (const SelectingEntry& it : kSelectingEntries)
    add(it.name, it.text, it.hint, chosen == &it, name_of(it.selecting));
  techniques->addSeparator();
  fill_holding(*techniques->addMenu("&Hold"));
  fill_travelling(*techniques->addMenu("Tra&vel (button 1, with the mouse Ctrl)"));
  techniques->addSeparator();
  record_ = add_action(*techniques, "technique.record", {}, {}, [this] { choose_recording(); });
  record_->setToolTip("What is done by the technique, to be done once more by icome edit --replay");
  apply();
}

void TechniqueActions::fill_holding(QMenu& menu) {
  auto* group = new QActionGroup(&menu);
  const auto* chosen = chosen_entry(kHoldingEntries, &HoldingEntry::holding, settings_, kHoldingKey);
  const auto add = [&](const char* name, const char* text, bool checked, std::string_view saved) {
    QAction* action = add_action(menu, name, text, {}, [this, saved] { choose(kHoldingKey, saved); });
    action->setCheckable(true);
    action->setChecked(checked);
    group->addAction(action);
  };
  add("technique.hold.suited", "As &Suits the Technique", !chosen, "suited");
  for (const HoldingEntry& it : kHoldingEntries) add(it.name, it.text, chosen == &it, name_of(it.holding));
}

void TechniqueActions::fill_travelling(QMenu& menu) {
  auto* group = new QActionGroup(&menu);
  const auto* chosen =
      chosen_entry(kTravellingEntries, &TravellingEntry::travelling, settings_, kTravellingKey);
  for (const TravellingEntry& it : kTravellingEntries) {
    QAction* action = add_action(menu, it.name, it.text, {},
                                 [this, way = it.travelling] { choose(kTravellingKey, name_of(way)); });
    action->setCheckable(true);
    action->setChecked(chosen ? chosen == &it : it.travelling == Travelling::None);
    group->addAction(action);
  }
}

}  // namespace icome::ui
