mortise_scene_test(interface CHECK interface.py RANKS 1 LONG_RANKS 3 LABELS sanitize ARGS -output_format xdmf,vtu)
mortise_scene_test(report SCENE interface CHECK report.py RANKS 1 LONG_RANKS 2 ARGS -report -title "<script>alert('a')</script> & \"b\" </title>")
mortise_scene_test(report_study LONG SCENE interface CHECK report.py ARGS -report -study uniform -study_levels 3 -study_orders 1,2 -title "<script>alert('a')</script> & \"b\" </title>")
mortise_scene_test(formats SCENE interface CHECK formats.py)
