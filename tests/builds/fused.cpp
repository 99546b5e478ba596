// Sums of products as they stand in the core, for a test that looks at the instructions they become.
struct Point {
  double x, y;
};

Point turned(Point p, double c, double s, Point by);
void turnAll(Point* __restrict to, const Point* __restrict from, int n, double c, double s);

Point turned(Point p, double c, double s, Point by) { return {c * p.x - s * p.y + by.x, s * p.x + c * p.y + by.y}; }

void turnAll(Point* __restrict to, const Point* __restrict from, int n, double c, double s) {
  for (int k = 0; k < n; ++k) {
    to[k].x = c * from[k].x - s * from[k].y;
    to[k].y = s * from[k].x + c * from[k].y;
  }
}
