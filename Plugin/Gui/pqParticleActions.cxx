// SPDX-License-Identifier: BSD-3-Clause
#include "pqParticleActions.h"

#include "pqActiveObjects.h"
#include "pqApplicationCore.h"
#include "pqDataRepresentation.h"
#include "pqFiltersMenuReaction.h"
#include "pqObjectBuilder.h"
#include "pqOutputPort.h"
#include "pqPVApplicationCore.h"
#include "pqPipelineSource.h"
#include "pqServer.h"
#include "pqUndoStack.h"
#include "pqView.h"
#include "vtkNew.h"
#include "vtkSMInputProperty.h"
#include "vtkSMParaViewPipelineControllerWithRendering.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMRepresentationProxy.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMViewProxy.h"

#include <QAction>
#include <QIcon>
#include <QMenu>
#include <QTimer>

namespace
{
constexpr const char* Filter = "SphereAmbientOcclusion";
constexpr const char* Spheres = "Ray-Traced Spheres";

/// May the filter have the selected data as its input?
bool canBake()
{
  pqOutputPort* port = pqActiveObjects::instance().activePort();
  vtkSMProxy* prototype =
    port ? port->getServer()->proxyManager()->GetPrototypeProxy("filters", Filter) : nullptr;
  auto* input =
    prototype ? vtkSMInputProperty::SafeDownCast(prototype->GetProperty("Input")) : nullptr;
  if (!input)
  {
    return false;
  }
  input->RemoveAllUncheckedProxies();
  input->AddUncheckedInputConnection(
    port->getSource()->getProxy(), static_cast<unsigned int>(port->getPortNumber()));
  const bool allowed =
    input->IsInDomains() > 0 && port->getSource()->modifiedState() != pqProxy::UNINITIALIZED;
  input->RemoveAllUncheckedProxies();
  return allowed;
}

/// The display of the selected data in the active view, if it can show spheres.
vtkSMProxy* activeDisplay()
{
  pqDataRepresentation* display = pqActiveObjects::instance().activeRepresentation();
  vtkSMProxy* proxy = display ? display->getProxy() : nullptr;
  return proxy && proxy->GetProperty("SilhouetteVisibility") ? proxy : nullptr;
}
}

pqParticleActions::pqParticleActions(QObject* parent)
  : Superclass(parent)
{
}

pqParticleActions::~pqParticleActions() = default;

QAction* pqParticleActions::add(
  const char* name, const char* icon, const char* text, const char* slot)
{
  const QIcon picture(QString(":/ParticleOcclusion/Icons/%1.svg").arg(icon));
  auto* action = new QAction(picture, text, this->Menu.data());
  action->setObjectName(name); // by which the search tells actions apart
  this->Menu->addAction(action);
  QObject::connect(action, SIGNAL(triggered()), this, slot);
  return action;
}

void pqParticleActions::startup()
{
  if (pqPVApplicationCore::instance())
  {
    this->addToSearch();
  }
  else
  {
    // A plugin that is loaded at the start comes before the search is there.
    QTimer::singleShot(0, this, SLOT(addToSearch()));
  }
}

void pqParticleActions::addToSearch()
{
  pqPVApplicationCore* core = pqPVApplicationCore::instance();
  if (!core || this->Menu)
  {
    return; // another program than ParaView
  }
  this->Menu.reset(new QMenu("Particles"));
  this->Menu->setObjectName("ParticleOcclusionSearch");
  this->Bake = this->add("ParticleOcclusion.Bake", "SphereAmbientOcclusion",
    "AO: Ambient Occlusion of Particles", SLOT(bake()));
  this->OfDisplay << this->add("ParticleOcclusion.ShowSpheres", "SphereAmbientOcclusion",
    "Spheres: Ray-Traced Particles", SLOT(showSpheres()));
  this->OfDisplay << this->add("ParticleOcclusion.ShowSilhouettes", "DepthSilhouettes",
    "Silhouettes: Outline Particles", SLOT(showSilhouettes()));
  this->OfServer << this->add("ParticleOcclusion.ShowSilhouetteView", "DepthSilhouettes",
    "Silhouettes: Outline All (New View)", SLOT(showSilhouetteView()));
  core->registerForQuicklaunch(this->Menu.data());
  QObject::connect(core, SIGNAL(aboutToShowQuickLaunch()), this, SLOT(updateActions()));
}

void pqParticleActions::shutdown()
{
  this->Menu.reset();
}

void pqParticleActions::updateActions()
{
  this->Bake->setEnabled(canBake());
  for (QAction* action : this->OfDisplay)
  {
    action->setEnabled(activeDisplay() != nullptr);
  }
  for (QAction* action : this->OfServer)
  {
    action->setEnabled(pqActiveObjects::instance().activeServer() != nullptr);
  }
}

void pqParticleActions::bake()
{
  pqFiltersMenuReaction::createFilter("filters", Filter);
}

void pqParticleActions::showSpheres()
{
  if (vtkSMProxy* display = activeDisplay())
  {
    BEGIN_UNDO_SET("Show as Ray-Traced Spheres");
    vtkSMRepresentationProxy::SetRepresentationType(display, Spheres);
    display->UpdateVTKObjects();
    END_UNDO_SET();
    pqActiveObjects::instance().activeRepresentation()->renderViewEventually();
  }
}

void pqParticleActions::showSilhouettes()
{
  if (vtkSMProxy* display = activeDisplay())
  {
    BEGIN_UNDO_SET("Show Silhouettes");
    vtkSMRepresentationProxy::SetRepresentationType(display, Spheres);
    vtkSMPropertyHelper(display, "SilhouetteVisibility").Set(1);
    display->UpdateVTKObjects();
    END_UNDO_SET();
    pqActiveObjects::instance().activeRepresentation()->renderViewEventually();
  }
}

void pqParticleActions::showSilhouetteView()
{
  BEGIN_UNDO_SET("Create Render View (Silhouettes)");
  pqObjectBuilder* builder = pqApplicationCore::instance()->getObjectBuilder();
  if (pqView* view = builder->createView(
        "RenderViewWithSilhouettes", pqActiveObjects::instance().activeServer()))
  {
    vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
    controller->AssignViewToLayout(view->getViewProxy());
  }
  END_UNDO_SET();
}
