import bpy

settings = bpy.context.scene.medial_axis

settings.theta = 0.39269908169872414
settings.rho = 16.0
settings.side = "AUTOMATIC"
settings.sides = "AUTOMATIC"
settings.rule = "EITHER"
settings.criteria = "ANGLE_OR_RATIO"
settings.limit_set = True
settings.sampling = "AUTOMATIC"
settings.samples = 16000
settings.spacing = 0.0
settings.epsilon = 0.25
settings.budget = 200000
settings.sharp_angle = 0.5235987755982988
settings.smooth = True
settings.keep_vertices = False
settings.seed = 0
