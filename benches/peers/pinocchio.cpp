// Writes the C that Pinocchio generates for a robot's inverse and forward dynamics into two
// folders: `pinocchio URDF RNEA ABA`.
#include <pinocchio/codegen/cppadcg-algo.hpp>
#include <pinocchio/parsers/urdf.hpp>

// The function alone, without its Jacobian, as source.
template <class Generator> struct Source : Generator
{
    using Generator::Generator;
    void write(const char *folder)
    {
        this->build_jacobian = false;
        this->initLib();
        CppAD::cg::SaveFilesModelLibraryProcessor<double>(*this->libcgen_ptr).saveSourcesTo(folder);
    }
};

int main(int argc, char **argv)
{
    if (argc != 4)
        return 2;
    pinocchio::Model model;
    pinocchio::urdf::buildModel(argv[1], model);
    Source<pinocchio::CodeGenRNEA<double>>(model, "rnea").write(argv[2]);
    Source<pinocchio::CodeGenABA<double>>(model, "aba").write(argv[3]);
}
