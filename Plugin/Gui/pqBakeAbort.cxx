// SPDX-License-Identifier: BSD-3-Clause
#include "pqBakeAbort.h"

#include "pqApplicationCore.h"
#include "pqCoreUtilities.h"
#include "pqPipelineSource.h"
#include "pqProgressManager.h"
#include "pqServerManagerModel.h"
#include "vtkAlgorithm.h"
#include "vtkCommand.h"
#include "vtkSMProxy.h"

#include <QApplication>
#include <QMouseEvent>
#include <QOpenGLWidget>
#include <QTimer>

#include <cstring>

namespace
{
/// Null where it runs on a server.
vtkAlgorithm* filterOf(pqPipelineSource* source)
{
  return vtkAlgorithm::SafeDownCast(source->getProxy()->GetClientSideObject());
}
}

pqBakeAbort::pqBakeAbort(QObject* parent)
  : Superclass(parent)
{
}

void pqBakeAbort::startup()
{
  pqApplicationCore* core = pqApplicationCore::instance();
  if (!core || this->Manager)
  {
    return;
  }
  this->Manager = core->getProgressManager();
  pqServerManagerModel* model = core->getServerManagerModel();
  QObject::connect(this->Manager, SIGNAL(abort()), this, SLOT(abort()));
  QObject::connect(
    model, SIGNAL(sourceAdded(pqPipelineSource*)), this, SLOT(watch(pqPipelineSource*)));
  for (pqPipelineSource* source : model->findItems<pqPipelineSource*>())
  {
    this->watch(source);
  }
}

void pqBakeAbort::shutdown()
{
  this->Manager.clear();
}

void pqBakeAbort::watch(pqPipelineSource* source)
{
  vtkAlgorithm* filter = filterOf(source);
  if (filter && std::strcmp(source->getProxy()->GetXMLName(), "SphereAmbientOcclusion") == 0)
  {
    pqCoreUtilities::connect(
      filter, vtkCommand::ProgressEvent, this, SLOT(listen(vtkObject*)), Qt::DirectConnection);
    pqCoreUtilities::connect(
      filter, vtkCommand::EndEvent, this, SLOT(forget()), Qt::DirectConnection);
  }
}

void pqBakeAbort::listen(vtkObject* filter)
{
  if (this->Running || !this->Manager)
  {
    return; // the events that are being taken have come to a bake again
  }
  this->Running = vtkAlgorithm::SafeDownCast(filter);
  this->Manager->setEnableAbort(true);
  const bool blocked = this->Manager->unblockEvents(true);
  QApplication::instance()->installEventFilter(this);
  // Timers would draw views in the middle of the pipeline's work.
  QApplication::processEvents(QEventLoop::ExcludeSocketNotifiers | QEventLoop::X11ExcludeTimers);
  QApplication::instance()->removeEventFilter(this);
  this->Manager->unblockEvents(blocked);
  this->Running = nullptr;
}

void pqBakeAbort::abort()
{
  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  for (pqPipelineSource* source : model->findItems<pqPipelineSource*>())
  {
    if (this->Running && filterOf(source) == this->Running)
    {
      this->Running->SetAbortExecute(1);
      this->Aborted = source;
    }
  }
}

void pqBakeAbort::forget()
{
  if (this->Manager)
  {
    this->Manager->setEnableAbort(false);
  }
  if (this->Aborted)
  {
    filterOf(this->Aborted)->SetAbortExecute(0);     // or the next bake would end at once
    QTimer::singleShot(0, this, SLOT(offerAgain())); // after what follows a bake
  }
}

void pqBakeAbort::offerAgain()
{
  if (this->Aborted)
  {
    this->Aborted->setModifiedState(pqProxy::MODIFIED);
    QObject::connect(this->Aborted, SIGNAL(modifiedStateChanged(pqServerManagerModelItem*)), this,
      SLOT(bakeAgain()), Qt::UniqueConnection);
  }
}

void pqBakeAbort::bakeAgain()
{
  if (this->Aborted && this->Aborted->modifiedState() == pqProxy::UNMODIFIED)
  {
    filterOf(this->Aborted)->Modified();
    vtkSMProxy* proxy = this->Aborted->getProxy();
    proxy->MarkDirty(proxy);
    this->Aborted = nullptr;
  }
}

bool pqBakeAbort::isForButton(QObject* receiver, const QPoint& place) const
{
  // The window passes the event on to the button, which gets it as the second receiver.
  QObject* target = receiver->isWindowType() ? QApplication::widgetAt(place) : receiver;
  return this->Manager->nonBlockableObjects().contains(target);
}

bool pqBakeAbort::eventFilter(QObject* receiver, QEvent* event)
{
  switch (event->type())
  {
    case QEvent::MouseButtonPress:
    case QEvent::MouseButtonRelease:
    case QEvent::MouseButtonDblClick:
    case QEvent::MouseMove:
      return !this->isForButton(receiver, static_cast<QMouseEvent*>(event)->globalPos());
    case QEvent::Close:
      event->ignore();
      return true;
    case QEvent::KeyPress:
    case QEvent::KeyRelease:
    case QEvent::Shortcut:
    case QEvent::Wheel:
    case QEvent::ContextMenu:
    case QEvent::DragEnter:
    case QEvent::Drop:
      return true;
    case QEvent::Paint:
    case QEvent::UpdateRequest:
      return qobject_cast<QOpenGLWidget*>(receiver) != nullptr; // a view
    default:
      return this->Superclass::eventFilter(receiver, event);
  }
}
