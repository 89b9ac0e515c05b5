/* Stands where Simulink would: a line of is_thesis, state[3] and input[6] in, its derivative and the step of
 * 0.1 ms out. */
#include <stdio.h>

#include "spindle_plant.h"

int main(void) {
  int is_thesis = 0;
  double x[3];
  double u[6];
  while (scanf("%d %lf %lf %lf %lf %lf %lf %lf %lf %lf", &is_thesis, &x[0], &x[1], &x[2], &u[0], &u[1], &u[2],
               &u[3], &u[4], &u[5]) == 10) {
    double rate[3] = {0.0, 0.0, 0.0};
    double next[3] = {0.0, 0.0, 0.0};
    if (spindle_plant_derivative(is_thesis, x, u, rate) != 0) return 1;
    if (spindle_plant_step(is_thesis, 1.0e-4, x, u, next) != 0) return 1;
    printf("%.17g %.17g %.17g %.17g %.17g %.17g\n", rate[0], rate[1], rate[2], next[0], next[1], next[2]);
  }
  return 0;
}
