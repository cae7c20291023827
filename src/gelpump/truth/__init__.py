"""The tube without slenderness: fully nonlinear poroelasticity in two dimensions."""
