// SPDX-License-Identifier: BSD-3-Clause
#ifndef pqParticleActions_h
#define pqParticleActions_h

#include <QList>
#include <QObject>
#include <QScopedPointer>

class QAction;
class QMenu;

/// What the search of ParaView (Ctrl+Space) finds beside filters and sources: a representation, its
/// lines and a view, by the words that users of particles know.
class pqParticleActions : public QObject
{
  Q_OBJECT
  typedef QObject Superclass;

public:
  explicit pqParticleActions(QObject* parent = nullptr);
  ~pqParticleActions() override;

  /// Called when the plugin is loaded, and when the program ends.
  void startup();
  void shutdown();

private Q_SLOTS:
  void addToSearch();
  void updateActions();
  void bake();
  void showSpheres();
  void showSilhouettes();
  void showSilhouetteView();

private:
  QAction* add(const char* name, const char* icon, const char* text, const char* slot);

  QScopedPointer<QMenu> Menu;
  QAction* Bake = nullptr;
  QList<QAction*> OfDisplay; ///< need particles that are shown
  QList<QAction*> OfServer;  ///< need a server
};

#endif
