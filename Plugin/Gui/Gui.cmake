# What the plugin adds to ParaView's window: widgets of the properties panel, entries of the search, icons. Sets
# gui_arguments for paraview_add_plugin.
set(gui_interfaces)
set(gui_sources)

# particleocclusion_property_widget(TYPE CLASS): CLASS is the widget of properties with panel_widget="TYPE".
macro (particleocclusion_property_widget type class)
  paraview_plugin_add_property_widget(
    KIND WIDGET
    TYPE "${type}"
    CLASS_NAME "${class}"
    INTERFACES interface
    SOURCES generated)
  list(APPEND gui_interfaces ${interface})
  list(APPEND gui_sources ${generated} "Gui/${class}.cxx" "Gui/${class}.h")
endmacro ()

particleocclusion_property_widget(information_text pqInformationText)
particleocclusion_property_widget(bake_estimate pqBakeEstimate)
particleocclusion_property_widget(presets pqPresets)

# particleocclusion_auto_start(CLASS): of CLASS there is an object as long as the program runs.
macro (particleocclusion_auto_start class)
  paraview_plugin_add_auto_start(
    CLASS_NAME "${class}"
    STARTUP startup
    SHUTDOWN shutdown
    INTERFACES interface
    SOURCES generated)
  list(APPEND gui_interfaces ${interface})
  list(APPEND gui_sources ${generated} "Gui/${class}.cxx" "Gui/${class}.h")
endmacro ()

particleocclusion_auto_start(pqParticleActions)
if (ParaView_VERSION VERSION_LESS 5.12) # which has a button of its own that works
  particleocclusion_auto_start(pqBakeAbort)
endif ()

set(gui_arguments
  UI_INTERFACES ${gui_interfaces}
  UI_RESOURCES Gui/ParticleOcclusion.qrc
  SOURCES ${gui_sources})
