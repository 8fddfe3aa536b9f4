// SPDX-License-Identifier: BSD-3-Clause
#ifndef pqBakeAbort_h
#define pqBakeAbort_h

#include "pqPipelineSource.h"

#include <QObject>
#include <QPointer>

class pqProgressManager;
class QPoint;
class vtkAlgorithm;
class vtkObject;

/// Lets the cross beside ParaView's progress bar stop a bake.
///
/// ParaView 5.11 has the button, but never enables it, takes no events while a filter runs, and
/// passes a click to nobody. This looks for the events of the window at every report of a bake, and
/// lets those of the button alone through. From a server there are no reports that could be
/// answered: the button stays grey. After an abort *Apply* offers to bake again.
class pqBakeAbort : public QObject
{
  Q_OBJECT
  typedef QObject Superclass;

public:
  explicit pqBakeAbort(QObject* parent = nullptr);

  /// Called when the plugin is loaded, and when the program ends.
  void startup();
  void shutdown();

  /// Holds back what would change the window, its views or the pipeline in the middle of a bake.
  bool eventFilter(QObject* receiver, QEvent* event) override;

private Q_SLOTS:
  void watch(pqPipelineSource* source);
  void listen(vtkObject* filter);
  void abort();
  void forget();
  void offerAgain();
  void bakeAgain();

private:
  bool isForButton(QObject* receiver, const QPoint& place) const;

  QPointer<pqProgressManager> Manager;
  vtkAlgorithm* Running = nullptr; ///< the filter that bakes, while it does
  QPointer<pqPipelineSource> Aborted;
};

#endif
