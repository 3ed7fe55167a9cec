#include "ui/actions/view_actions.h"

#include <QInputDialog>
#include <algorithm>
#include <utility>

#include "render/model/views.h"
#include "ui/actions/actions.h"
#include "ui/look/icons.h"
#include "ui/panels/object_look.h"

namespace icome::ui {
namespace {

using interaction::NavigationMode;

struct DirectionEntry {
  const char* direction;  // as render::view_direction knows it
  const char* name;
  const char* text;
  const char* keys;
};
constexpr DirectionEntry kDirections[] = {
    {"front", "view.front", "&Front", "1"}, {"back", "view.back", "&Back", "Ctrl+1"},
    {"right", "view.right", "&Right", "3"}, {"left", "view.left", "&Left", "Ctrl+3"},
    {"top", "view.top", "&Top", "7"},       {"bottom", "view.bottom", "Botto&m", "Ctrl+7"},
    {"iso", "view.iso", "&Isometric", "0"},
};

/// A name from a design as text of a menu entry; `otherwise` where the name is empty.
QString entry_of(const std::string& name, const char* otherwise) {
  const QString line = shortened(one_line(name));
  return line.isEmpty() ? QString(otherwise) : QString(line).replace('&', "&&");
}

}  // namespace

ViewActions::ViewActions(session::Session& session, SceneTools& tools, QSettings& settings)
    : session_(session), tools_(tools), settings_(settings) {}

void ViewActions::fill(QMenu& menu) {
  home_ = add_action(menu, "view.home", "&Home", {}, [this] { session_.view().home(); });
  home_->setShortcuts({QKeySequence("H"), QKeySequence("Home")});
  home_->setIcon(icon(Icon::Home));
  zoom_ = add_action(menu, "view.zoom", "&Zoom to Selection", QKeySequence("F"),
                     [this] { ui::zoom_to_selection(session_, tools_.aspect()); });
  zoom_->setIcon(icon(Icon::ZoomToSelection));
  add_action(menu, "view.closer", "&Closer", {}, [this] {
    zoom_in_middle(session_, 1.0);
  })->setShortcuts({QKeySequence("+"), QKeySequence("Ctrl++"), QKeySequence("=")});
  add_action(menu, "view.farther", "F&arther", {}, [this] {
    zoom_in_middle(session_, -1.0);
  })->setShortcuts({QKeySequence("-"), QKeySequence("Ctrl+-")});
  menu.addSeparator();
  fill_directions(menu);
  fill_viewpoints(menu);
  fill_scenes(menu);
  fill_motions(menu);
  menu.addSeparator();
  grid_ = add_switch(menu, "view.grid", "&Grid", QKeySequence("G"));
  shadows_ = add_switch(menu, "view.shadows", "&Shadows", {});
  menu.addSeparator();
  fill_modes(menu);
  QAction* const recentre =
      add_action(menu, "view.recentre_head", "&Recentre Head", QKeySequence("Ctrl+Shift+R"),
                 [this] { session_.view().recentre_head(); });
  recentre->setToolTip("From now on you look straight ahead where your head is now");
  recentre->setEnabled(session_.view().has_head());
  fill_stereo(menu);
  menu.addSeparator();
  fill_themes(menu);
}

QAction* ViewActions::add_switch(QMenu& menu, const char* name, const QString& text,
                                 const QKeySequence& keys) {
  QAction* action = menu.addAction(text);
  action->setObjectName(name);
  action->setShortcut(keys);
  action->setCheckable(true);
  action->setChecked(settings_.value(name, true).toBool());
  QObject::connect(action, &QAction::toggled, action, [this, name](bool on) {
    settings_.setValue(name, on);
    look_changed_();
  });
  return action;
}

void ViewActions::fill_directions(QMenu& menu) {
  QMenu* directions = menu.addMenu("Look &From");
  for (const DirectionEntry& it : kDirections) {
    const auto direction = render::view_direction(it.direction);
    if (!direction) continue;
    add_action(*directions, it.name, it.text, QKeySequence(it.keys), [this, direction] {
      look_from(session_, direction->toward_eye, direction->up, tools_.aspect());
    });
  }
}

void ViewActions::fill_viewpoints(QMenu& menu) {
  QMenu* viewpoints = menu.addMenu("&Viewpoints");
  viewpoints->setObjectName("view.viewpoints");
  QObject::connect(viewpoints, &QMenu::aboutToShow, viewpoints, [this, viewpoints] {
    viewpoints->clear();
    const auto& there = session_.view().drawn()->viewpoints();
    for (std::size_t i = 0; i < there.size(); ++i) {
      add_action(*viewpoints, "view.viewpoint", entry_of(there[i].name, "Viewpoint without a name"), {},
                 [this, viewpoint = there[i]] { look_from(session_, viewpoint); });
    }
    if (there.empty()) viewpoints->addAction("This design has none")->setEnabled(false);
  });
}

void ViewActions::fill_scenes(QMenu& menu) {
  QMenu* scenes = menu.addMenu("S&cenes");
  scenes->setObjectName("view.scenes");
  QObject::connect(scenes, &QMenu::aboutToShow, scenes, [this, scenes] {
    scenes->clear();
    const auto add = [this, scenes](const QString& text, world::SceneId id) {
      QAction* action = add_action(*scenes, "view.scene", text, {}, [this, id] {
        tools_.finish();
        session_.stage().show_scene(id);
      });
      action->setCheckable(true);
      action->setChecked(session_.stage().shown_scene() == id);
    };
    add("The &Whole World", {});
    scenes->addSeparator();
    std::vector<std::pair<world::SceneId, std::string>> all;
    for (const auto& [id, scene] : session_.world().scenes()) all.emplace_back(id, scene.name);
    std::sort(all.begin(), all.end());  // in the order in which they were made
    for (const auto& [id, name] : all) add(entry_of(name, "Scene without a name"), id);
    if (all.empty()) scenes->addAction("This design has none of its own")->setEnabled(false);
  });
}

void ViewActions::fill_motions(QMenu& menu) {
  play_ = add_action(menu, "view.play", "&Play Motions", QKeySequence("F5"), [this] {
    session_.stage().play(!session_.stage().playing() && session_.stage().has_motions());
    refresh();
  });
  play_->setCheckable(true);
  QObject::connect(&menu, &QMenu::aboutToShow, play_, [this] {
    play_->setText(session_.stage().has_motions() ? "&Play Motions" : "&Play Motions (This Design Has None)");
  });
  play_->setToolTip("Objects move as their files say, seen and felt; again puts them back");
}

void ViewActions::fill_modes(QMenu& menu) {
  auto* modes = new QActionGroup(&menu);
  const auto add = [&](const char* name, const QString& text, NavigationMode mode) {
    QAction* action =
        add_action(menu, name, text, {}, [this, mode] { session_.view().set_navigation_mode(mode); });
    action->setCheckable(true);
    modes->addAction(action);
    return action;
  };
  camera_ = add("view.camera_mode", "3D Mouse Moves the &Eye", NavigationMode::Camera);
  hand_ = add("view.hand_mode", "3D Mouse Moves the Ha&nd", NavigationMode::Hand);
  camera_->setToolTip("Camera mode: moving the 3D mouse moves the eye, and the hand with it");
  hand_->setToolTip("Hand mode: moving the 3D mouse moves the hand, and the eye stays");
}

void ViewActions::fill_stereo(QMenu& menu) {
  using interaction::StereoKind;
  fish_tank_ = add_action(menu, "view.fish_tank", "Screen as a &Window (Fish Tank)", {},
                          [this] { session_.view().set_fish_tank(fish_tank_->isChecked()); });
  fish_tank_->setCheckable(true);
  fish_tank_->setToolTip("The scene stands behind and before the screen, seen from where your head is");
  QMenu* const ways = menu.addMenu("Stere&o");
  ways->setObjectName("view.stereo");
  stereo_ = new QActionGroup(ways);
  const auto add = [&](const char* name, const char* text, StereoKind kind) {
    QAction* const action = add_action(*ways, name, text, {}, [this, kind] {
      auto stereo = session_.view().stereo();
      stereo.kind = kind;
      session_.view().set_stereo(stereo);
    });
    action->setCheckable(true);
    action->setData(int(kind));
    stereo_->addAction(action);
  };
  add("view.stereo_off", "&Off", StereoKind::Off);
  add("view.stereo_anaglyph", "&Anaglyph (Red and Cyan Glasses)", StereoKind::Anaglyph);
  add("view.stereo_side_by_side", "&Side by Side", StereoKind::SideBySide);
  add("view.stereo_top_bottom", "&Left Above Right", StereoKind::TopBottom);
  ways->addSeparator();
  squeezed_ = add_action(*ways, "view.stereo_squeezed", "S&queezed, for 3D Displays", {}, [this] {
    auto stereo = session_.view().stereo();
    stereo.squeezed = squeezed_->isChecked();
    session_.view().set_stereo(stereo);
  });
  squeezed_->setCheckable(true);
  squeezed_->setToolTip("Each half of the window holds the whole picture: the display stretches it");
  add_action(*ways, "view.eye_distance", "&Eye Distance...", {}, [this, ways] { ask_eye_distance(ways); });
}

void ViewActions::ask_eye_distance(QWidget* parent) {
  while (parent->parentWidget()) parent = parent->parentWidget();  // a menu is a window of its own
  constexpr double kMillimetres = 1000.0;
  bool taken = false;
  auto stereo = session_.view().stereo();
  const double distance = QInputDialog::getDouble(
      parent, "Eye Distance",
      "Between the middles of your pupils, in mm:", kMillimetres * stereo.eye_distance, 0.0,
      kMillimetres * interaction::StereoSettings::kMostEyeDistance, 1, &taken);
  if (!taken) return;
  stereo.eye_distance = distance / kMillimetres;
  session_.view().set_stereo(stereo);
}

void ViewActions::fill_themes(QMenu& menu) {
  QMenu* themes = menu.addMenu("&Theme");
  themes_ = new QActionGroup(themes);
  const auto add = [&](const char* text, Theme theme) {
    QAction* action = add_action(*themes, "view.theme", text, {}, [this, theme] { theme_changed_(theme); });
    action->setCheckable(true);
    action->setData(int(theme));
    themes_->addAction(action);
  };
  add("As the &System", Theme::System);
  add("&Dark", Theme::Dark);
  add("&Light", Theme::Light);
}

void ViewActions::show_theme(Theme theme) {
  for (QAction* action : themes_->actions()) action->setChecked(action->data().toInt() == int(theme));
}

void ViewActions::refresh() {
  const bool camera = session_.view().navigation_mode() == NavigationMode::Camera;
  if (camera_->isChecked() != camera) (camera ? camera_ : hand_)->setChecked(true);
  const interaction::StereoSettings stereo = session_.view().stereo();
  for (QAction* const action : stereo_->actions())
    if (action->data().toInt() == int(stereo.kind) && !action->isChecked()) action->setChecked(true);
  squeezed_->setChecked(stereo.squeezed);
  fish_tank_->setChecked(session_.view().is_fish_tank());
  if (play_->isChecked() != session_.stage().playing()) play_->setChecked(session_.stage().playing());
}

}  // namespace icome::ui
