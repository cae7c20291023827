"""Each partial differential equation solved a second time, and the two solutions compared.

Nothing here knows the production solvers, nor they this: other variables, other meshes, other
formulae in time (SUNDIALS where production steps FiPy, Radau where it steps CVODE).  Where both
agree, an error would have to have been made twice.
"""
